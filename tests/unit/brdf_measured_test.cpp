#include <gtest/gtest.h>

#include <cstring>
#include <fstream>
#include <random>

#include "burnish/brdf/limited_brdf.h"
#include "burnish/brdf/measured/half_difference.h"
#include "burnish/brdf/measured/measured_brdf.h"
#include "burnish/brdf/measured/observer.h"
#include "burnish/brdf/measured/scattered_brdf.h"
#include "burnish/brdf/model_brdf.h"
#include "burnish/brdf/ward.h"
#include "expect_error.h"
#include "scratch_dir.h"

namespace burnish {
namespace {

using testing::ScratchDir;

Vec3d direction(double theta, double phi) {
  return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
}

std::vector<std::pair<Vec3d, Vec3d>> pairs(int count, double steepest = 1.5) {
  std::mt19937 random(5);
  const auto uniform = [&] { return double(random()) / 4294967296.0; };
  std::vector<std::pair<Vec3d, Vec3d>> out;
  for (int i = 0; i < count; i++) {
    const Vec3d l = direction(steepest * uniform(), 2 * kPi * uniform());
    out.emplace_back(l, direction(steepest * uniform(), 2 * kPi * uniform()));
  }
  return out;
}

void expect_near(Vec3d a, Vec3d b, double tolerance) {
  EXPECT_LE(length(a - b), tolerance) << a.x << " " << a.y << " " << a.z << ", expected " << b.x << " " << b.y << " "
                                      << b.z;
}

template <typename T>
std::string raw(T value) {
  std::string bytes(sizeof value, '\0');
  std::memcpy(bytes.data(), &value, sizeof value);
  return bytes;
}

std::shared_ptr<const Brdf> read_back(const std::string& name, const std::string& bytes) {
  const ScratchDir dir;
  const FileRef file = dir / name;
  std::ofstream(file.path, std::ios::binary) << bytes;
  return read_measured_brdf(file);
}

TEST(ModelBrdf, IsItsFormulaWithADiffusePart) {
  const LocalFrame frame{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const auto brdf = model_brdf("ward:ax=0.2,ay=0.5,ks=0.7,kd=0.3");
  for (const auto& [l, v] : pairs(100)) {
    const double wanted = 0.3 / kPi * l.z + ward(frame, {0.7, 0.2, 0.5}, l, v);
    expect_near(brdf->reflected(l, v), {wanted, wanted, wanted}, 1e-12 * (1 + wanted));
  }
  const Vec3d up{0, 0, 1}, slanted = normalized(Vec3d{1, 0, 1});
  expect_near(brdf->reflected(-up, up), {}, 0);
  expect_near(brdf->reflected(up, -up), {}, 0);
  // k_s F(N, e) at e = 1, and fibres along x that are lit and seen from above.
  expect_near(model_brdf("blinn-phong:ks=0.25,n=9")->reflected(up, up), {0.25, 0.25, 0.25}, 1e-15);
  expect_near(model_brdf("banks:ks=0.5")->reflected(up, up), {0.5, 0.5, 0.5}, 1e-15);
  EXPECT_GT(model_brdf("ward:")->reflected(slanted, up).x, 0);
}

TEST(ModelBrdf, RefusesWhatMeansNothing) {
  const auto refused = [](const std::string& source, const std::string& why) {
    EXPECT_ERROR(model_brdf(source), ErrorKind::kUsage, why);
  };
  refused("phong:n=3", "expected the model ward, banks or blinn-phong, got 'phong'");
  refused("ward:n=3", "expected parameters out of ax, ay, kd, ks, got 'n'");
  refused("banks:ax=1", "expected parameters out of kd, ks, got 'ax'");
  refused("ward:ax=0", "expected ax as a number above 0, got '0'");
  refused("ward:ks=-1", "expected ks as a number of at least 0, got '-1'");
  refused("ward:ks=1x", "got '1x'");
  refused("ward:ks", "got ''");
  refused("ward:ks=inf", "got 'inf'");
  refused("ward:ks=1,ks=2", "'ks' is given twice");
  EXPECT_TRUE(is_model_source("wrad:ax=0.2"));
  EXPECT_FALSE(is_model_source("paint.brdf"));
  EXPECT_FALSE(is_model_source("./ward:x.brdf"));
}

TEST(LimitedBrdf, HoldsTheCeiling) {
  const auto ward = model_brdf("ward:ax=0.05,ay=0.05");
  const LimitedBrdf limited(ward, 1);
  for (const auto& [l, v] : pairs(200)) EXPECT_EQ(limited.reflected(l, v).x, std::min(1.0, ward->reflected(l, v).x));
  EXPECT_EQ(limited.reflected({0, 0, 1}, {0, 0, 1}).x, 1);
}

TEST(HalfDifference, TellsNeitherLightFromViewNorHowTheSurfaceIsTurned) {
  for (const auto& [l, v] : pairs(200)) {
    const HalfDifference a = half_difference(l, v), b = half_difference(v, l);
    EXPECT_NEAR(a.theta_h, b.theta_h, 1e-12);
    EXPECT_NEAR(a.theta_d, b.theta_d, 1e-12);
    EXPECT_NEAR(std::cos(2 * (a.phi_d - b.phi_d)), 1, 1e-12);
    EXPECT_NEAR(std::cos(a.theta_d), dot(l, normalized(l + v)), 1e-12);
    const auto turn = [](Vec3d d) { return Vec3d{0.6 * d.x - 0.8 * d.y, 0.8 * d.x + 0.6 * d.y, d.z}; };
    const HalfDifference c = half_difference(turn(l), turn(v));
    EXPECT_NEAR(a.theta_h, c.theta_h, 1e-12);
    EXPECT_NEAR(std::cos(2 * (a.phi_d - c.phi_d)), 1, 1e-12);
  }
  // In the plane of the normal φ_d is 0, across it a quarter turn.
  EXPECT_NEAR(std::sin(half_difference(direction(0.9, 0), direction(0.1, 0)).phi_d), 0, 1e-12);
  EXPECT_NEAR(half_difference(direction(0.8, 0.3), direction(0.8, -0.3)).phi_d, kPi / 2, 1e-12);
}

// Cells of 3 × 4 × 5 whose values say which they are.
std::string merl(double (*value)(int plane, int h, int d, int p)) {
  std::string bytes = raw(3) + raw(4) + raw(5);
  for (int plane = 0; plane < 3; plane++)
    for (int h = 0; h < 3; h++)
      for (int d = 0; d < 4; d++)
        for (int p = 0; p < 5; p++) bytes += raw(value(plane, h, d, p));
  return bytes;
}

// Of a cell's middle.
std::pair<Vec3d, Vec3d> middle(int h, int d, int p) {
  const double root = (h + 0.5) / 3, theta_h = kPi / 2 * root * root, theta_d = kPi / 2 * (d + 0.5) / 4,
               phi = kPi * (p + 0.5) / 5;
  const Vec3d half = direction(theta_h, 0), away{half.z, 0, -half.x};
  const Vec3d off = (away * std::cos(phi) + Vec3d{0, 1, 0} * std::sin(phi)) * std::sin(theta_d);
  return {half * std::cos(theta_d) + off, half * std::cos(theta_d) - off};
}

TEST(Merl, CellsHoldTheirValuesInTheOrderOfTheFile) {
  const auto brdf = read_back("m.binary", merl([](int plane, int h, int d, int p) {
                                const double scale[] = {1500, 1500 / 1.15, 1500 / 1.66};
                                return scale[plane] * (1 + plane + 10 * h + 100 * d + 1000 * p);
                              }));
  int seen = 0;
  for (int h = 0; h < 3; h++)
    for (int d = 0; d < 4; d++)
      for (int p = 0; p < 5; p++) {
        const auto [l, v] = middle(h, d, p);
        if (!(l.z > 0 && v.z > 0)) continue;
        const double red = 1 + 10 * h + 100 * d + 1000 * p;
        expect_near(brdf->reflected(l, v), Vec3d{red, red + 1, red + 2} * l.z, 1e-3);
        expect_near(brdf->reflected(v, l), Vec3d{red, red + 1, red + 2} * v.z, 1e-3);
        seen++;
      }
  EXPECT_GT(seen, 20);
}

TEST(Merl, WhatIsNotMeasuredTakesNoPart) {
  const auto brdf = read_back(
      "m.binary", merl([](int plane, int h, int d, int) { return h == 1 && d == 1 && plane == 2 ? -1 : 1500.0; }));
  for (const auto& [l, v] : pairs(200)) {
    const double red = brdf->reflected(l, v).x;
    EXPECT_TRUE(red == 0 || std::abs(red - l.z) < 1e-6) << red;
  }
}

TEST(Merl, RefusesWrongSizes) {
  const std::string good = merl([](int, int, int, int) { return 1.0; });
  const auto refused = [](const std::string& bytes, const std::string& why) {
    EXPECT_ERROR(read_back("m.binary", bytes), ErrorKind::kMalformed, why);
  };
  refused("", "expected three counts of cells in 12 bytes, got 0 bytes");
  refused(good.substr(0, good.size() - 1), "expected 1452 bytes of 3x4x5 cells, got 1451");
  refused(good + "x", "got 1453");
  refused(raw(2147483647) + raw(2147483647) + raw(2147483647),
          "expected counts of cells from 1 to 4096, got 2147483647");
  refused(raw(4096) + raw(4096) + raw(4096), "expected 1649267441676 bytes");
  refused(raw(-3) + raw(-4) + raw(5), "from 1 to 4096, got -3");
  refused(good.substr(0, good.size() - 8) + raw(std::nan("")), "expected finite numbers");
  EXPECT_ERROR(read_measured_brdf(FileRef("nothing.binary")), ErrorKind::kIo, "'nothing.binary'");
  EXPECT_ERROR(read_measured_brdf(FileRef("paint.txt")), ErrorKind::kUsage,
               "'paint.txt': expected a model such as ward");
}

std::string mbsdf(int type, int thetas, int phis, const std::string& before = "") {
  std::string bytes =
      "NVIDIA ARC MBSDF V1\n" + before + "MBSDF_DATA_REFLECTION=\n" + raw(type) + raw(thetas) + raw(phis);
  for (int in = 0; in < thetas; in++)
    for (int out = 0; out < thetas; out++)
      for (int p = 0; p < phis; p++)
        for (int c = 0; c < (type == 1 ? 3 : 1); c++) bytes += raw(float(c + 10 * in + 100 * out + 1000 * p));
  return bytes;
}

TEST(Mbsdf, ValuesStandAtTheMiddlesOfAngles) {
  for (const int type : {0, 1}) {
    const auto brdf = read_back("m.mbsdf", mbsdf(type, 3, 4, "creator=\"someone\"\n"));
    for (int in = 0; in < 3; in++)
      for (int out = 0; out < 3; out++)
        for (int p = 0; p < 4; p++)
          for (const int side : {-1, 1}) {
            const Vec3d l = direction(kPi / 2 * (in + 0.5) / 3, 1),
                        v = direction(kPi / 2 * (out + 0.5) / 3, 1 + side * kPi * (p + 0.5) / 4);
            const double first = 10 * in + 100 * out + 1000 * p, c = type;
            expect_near(brdf->reflected(l, v), Vec3d{first, first + c, first + 2 * c} * l.z, 1e-2);
          }
  }
}

TEST(Mbsdf, RefusesWhatDoesNotFit) {
  const std::string good = mbsdf(1, 2, 2);
  const auto refused = [](const std::string& bytes, const std::string& why, ErrorKind kind = ErrorKind::kMalformed) {
    EXPECT_ERROR(read_back("m.mbsdf", bytes), kind, why);
  };
  refused("PNG", "expected measurements that begin with NVIDIA ARC MBSDF V1, got 'PNG'");
  refused("NVIDIA ARC MBSDF V1\nwhat\n", "expected a line KEY=");
  refused("NVIDIA ARC MBSDF V1\na=\"b\"\n", "got the end of the file");
  refused("NVIDIA ARC MBSDF V1\nMBSDF_DATA_TRANSMISSION=\n", "got transmitted light", ErrorKind::kUnsupported);
  refused(good.substr(0, good.size() - 1), "expected 96 bytes of 2x2x2 values, got 95");
  refused(good.substr(0, 50), "expected 12 bytes");
  refused(mbsdf(2, 1, 1), "expected the type 0 (grey) or 1 (RGB), got 2");
  refused("NVIDIA ARC MBSDF V1\nMBSDF_DATA=\n" + raw(1) + raw(-1) + raw(-1), "expected 1 to 4096 angles");
  refused(good.substr(0, good.size() - 4) + raw(std::nanf("")), "expected finite numbers");
}

TEST(Observer, SeesDaylightWhereItIs) {
  Vec3d sum;
  double brightest = 0, at = 0;
  for (int nm = 380; nm <= 780; nm++) {
    const Vec3d xyz = cie_1931_observer(nm);
    sum += xyz * daylight_d65(nm);
    if (xyz.y > brightest) brightest = xyz.y, at = nm;
  }
  EXPECT_NEAR(sum.x / (sum.x + sum.y + sum.z), 0.3127, 0.002);
  EXPECT_NEAR(sum.y / (sum.x + sum.y + sum.z), 0.3290, 0.002);
  EXPECT_NEAR(brightest, 1, 0.01);
  EXPECT_NEAR(at, 555, 5);
}

TEST(Observer, GreyIsGreyAndColoursAreTheirs) {
  std::vector<double> nm;
  for (int i = 0; i < 31; i++) nm.push_back(400 + 10 * i);
  const std::vector<Vec3d> weights = srgb_weights(nm);
  Vec3d grey, low, middle, high;
  for (std::size_t i = 0; i < nm.size(); i++) {
    grey += weights[i];
    (nm[i] < 490 ? low : nm[i] < 580 ? middle : high) += weights[i];
  }
  expect_near(grey, {1, 1, 1}, 1e-12);
  EXPECT_TRUE(low.z > 0.8 && low.x < 0.2 && low.y < 0.2);
  EXPECT_TRUE(middle.y > 0.8 && middle.x < 0.4 && middle.z < 0.3);
  EXPECT_TRUE(high.x > 0.6 && high.y < 0.3 && high.z < 0.1);
}

std::vector<ReflectanceSample> samples(int count) {
  std::vector<ReflectanceSample> out;
  for (const auto& [l, v] : pairs(count)) out.push_back({l, v, {std::exp(6 * v.x), 0.01 + l.y * l.y, l.z - 0.3}});
  return out;
}

TEST(Scattered, IsExactAtSamplesAndWithinThemElsewhere) {
  const auto given = samples(300);
  const ScatteredReflectance scattered(given);
  Vec3d least{1e9, 1e9, 1e9}, most = -least;
  for (const ReflectanceSample& s : given) {
    expect_near(scattered.at(s.l, s.v), s.reflected, 1e-6 * (1 + length(s.reflected)));
    expect_near(scattered.at(s.v, s.l), s.reflected, 1e-6 * (1 + length(s.reflected)));
    least = {std::min(least.x, s.reflected.x), std::min(least.y, s.reflected.y), std::min(least.z, s.reflected.z)};
    most = {std::max(most.x, s.reflected.x), std::max(most.y, s.reflected.y), std::max(most.z, s.reflected.z)};
  }
  for (const auto& [v, l] : pairs(2000)) {
    const Vec3d at = scattered.at(l, v), back = scattered.at(v, l),
                mirrored = scattered.at({l.x, -l.y, l.z}, {v.x, -v.y, v.z});
    expect_near(at, back, 1e-6 * (1 + length(at)));
    expect_near(at, mirrored, 1e-6 * (1 + length(at)));
    EXPECT_GE(at.x, least.x - 1e-9);
    EXPECT_GE(at.z, least.z - 1e-9);
    EXPECT_LE(at.x, most.x * (1 + 1e-9));
    EXPECT_LE(at.y, most.y * (1 + 1e-9));
  }
}

TEST(Scattered, SamplesAtOnePlaceAreThatValueEverywhere) {
  std::vector<ReflectanceSample> same(20, {{0, 0, 1}, {0, 0, 1}, {0.5, 0.25, 1}});
  const ScatteredReflectance scattered(same);
  for (const auto& [l, v] : pairs(50)) expect_near(scattered.at(l, v), {0.5, 0.25, 1}, 1e-12);
}

std::string cornell(int count, const char* value) {
  std::string text = "# a comment\n3\n400 550 700\n";
  for (int i = 0; i < count; i++)
    text += std::to_string(0.1 * (i % 14)) + " 0 " + std::to_string(0.11 * (i % 13)) + " " +
            std::to_string(0.4 * (i % 7)) + " " + value + " " + value + "\n" + value + "\n";
  return text;
}

TEST(Cornell, AnEvenSpectrumIsGreyFromEverywhere) {
  const auto brdf = read_back("c.brdf", cornell(200, "0.3"));
  for (const auto& [l, v] : pairs(100)) expect_near(brdf->reflected(l, v), Vec3d{0.3, 0.3, 0.3} * l.z, 1e-6);
}

TEST(Cornell, RefusalsNameTheLine) {
  const auto refused = [](const std::string& text, const std::string& why) {
    EXPECT_ERROR(read_back("c.brdf", text), ErrorKind::kMalformed, why);
  };
  refused("", "line 1: expected the number of wavelengths, got the end of the file");
  refused("# 3\nx", "line 2: expected the number of wavelengths from 2 to 1000, got 'x'");
  refused("2.5", "expected the number of wavelengths, got 2.5");
  refused("1e9", "expected the number of wavelengths from 2 to 1000");
  refused("2\n400 300", "line 2: expected a wavelength in nm from 380 to 780, got '300'");
  refused("2\n500 400", "line 2: expected wavelengths that ascend, got 400");
  refused("2\n400 500\n0 0 0 0 1\n", "line 4: expected a reflectance in 1/sr, got the end of the file");
  refused("2\n400 500\n0 0 1.6 0 1 1\n", "line 3: expected an angle from the normal from 0 to 1.5707, got '1.6'");
  refused("2\n400 500\n0 0 nan 0 1 1\n", "got 'nan'");
  refused("2\n400 500\n0 0 1 0 1 -1\n", "line 3: expected a reflectance in 1/sr from 0 to 1e+06, got '-1'");
  refused(cornell(10, "1"), "expected more than 10 samples, got 10");
}

TEST(MeasuredBrdf, DamagedFilesAreRefusedOrRead) {
  const std::string good[] = {merl([](int, int h, int, int p) { return 100.0 * h + p; }), mbsdf(1, 3, 3),
                              cornell(12, "0.5")};
  const char* const names[] = {"m.binary", "m.mbsdf", "m.brdf"};
  std::mt19937 random(3);
  for (int i = 0; i < 240; i++) {
    const int which = i % 3;
    if (which == 2 && i > 60) continue;  // each fills a table
    std::string bytes = good[which];
    for (int k = 0; k < 1 + i % 4; k++)
      bytes[random() % (which == 2 ? bytes.size() : std::min<std::size_t>(bytes.size(), 96))] = char(random());
    if (i % 5 == 0) bytes.resize(random() % bytes.size());
    try {
      const auto brdf = read_back(names[which], bytes);
      for (const auto& [l, v] : pairs(20))
        EXPECT_FALSE(std::isnan(brdf->reflected(l, v).x)) << names[which] << " " << i;
    } catch (const Error& error) {
      EXPECT_TRUE(error.kind() == ErrorKind::kMalformed || error.kind() == ErrorKind::kUnsupported) << error.what();
    }
  }
}

}  // namespace
}  // namespace burnish
