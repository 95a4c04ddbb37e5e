#include "burnish/ptm/files/jpeg_planes.h"

#include <limits>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "burnish/core/error.h"
#include "burnish/core/parallel.h"
#include "burnish/ptm/files/grey_jpeg.h"
#include "burnish/ptm/files/plane.h"

namespace burnish {
namespace {

constexpr int kInverted = 1, kMoved = 2;
constexpr std::size_t kRecord = 5;  // of side information

std::size_t plane_count(const PtmShape& shape) {
  return std::size_t(shape.polynomials()) * kPtmTerms + std::size_t(shape.colours());
}

std::string plane_name(std::size_t i) { return "plane " + std::to_string(i); }

// How the planes are stored and put together.
struct Plan {
  std::vector<int> transforms, reference;
  std::vector<int> sequence;  // planes in the order in which they are put together
  std::vector<std::string_view> streams, corrections;
};

std::vector<int> read_sequence(HeaderText& header, std::size_t n) {
  const std::vector<int> order = header.integers("a plane's order", n, 0, int(n) - 1);
  std::vector<int> sequence(n, -1);
  for (std::size_t i = 0; i < n; i++) {
    if (sequence[order[i]] >= 0)
      header.fail("expected each plane to have its own place in the order, got " + std::to_string(order[i]) + " twice");
    sequence[order[i]] = int(i);
  }
  return sequence;
}

Plan read_plan(HeaderText& header, std::size_t n) {
  constexpr int kMost = std::numeric_limits<int>::max() / 2;
  Plan plan;
  header.integer("a quality", -kMost, kMost);
  plan.transforms = header.integers("a plane's transforms", n, 0, kInverted | kMoved);
  const std::vector<int> x = header.integers("a plane's motion", n, -kMost, kMost),
                         y = header.integers("a plane's motion", n, -kMost, kMost);
  plan.sequence = read_sequence(header, n);
  plan.reference = header.integers("a reference plane", n, -1, int(n) - 1);
  std::vector<bool> done(n);
  for (const int i : plan.sequence) {
    const int of = plan.reference[i];
    if (of >= 0 && !done[of])
      header.fail("expected " + plane_name(i) + " to refer to one before it in the order, got " + plane_name(of));
    if (of >= 0 && (plan.transforms[i] & kMoved) && (x[i] != 0 || y[i] != 0))
      throw file_error(ErrorKind::kUnsupported, header.name(),
                       plane_name(i) + ": expected a reference plane in place, got motion compensation");
    done[i] = true;
  }
  const std::vector<int> sizes = header.integers("the size of a plane", n, 1, kMost),
                         sides = header.integers("the size of side information", n, 0, kMost);
  std::string_view body = header.body("sizes");
  const auto take = [&](int size) {
    const std::string_view part = body.substr(0, std::size_t(size));
    body.remove_prefix(part.size());
    return part;
  };
  for (std::size_t i = 0; i < n; i++) {
    plan.streams.push_back(take(sizes[i]));
    plan.corrections.push_back(take(sides[i]));
    const std::size_t got = plan.streams[i].size() + plan.corrections[i].size(),
                      wanted = std::size_t(sizes[i]) + sides[i];
    if (got < wanted)
      header.fail(plane_name(i) + ": expected " + std::to_string(wanted) + " bytes, got " + std::to_string(got));
  }
  return plan;
}

void predict(const Plane& plane, const Plane& reference, bool inverted) {
  for (int y = 0; y < plane.height; y++)
    for (int x = 0; x < plane.width; x++) {
      const int from = inverted ? 255 - reference.at(y, x) : reference.at(y, x);
      plane.at(y, x) = std::uint8_t(plane.at(y, x) + from - 128);
    }
}

void correct(const Plane& plane, std::string_view records, const HeaderText& header, std::size_t i) {
  if (records.size() % kRecord)
    header.fail(plane_name(i) + ": expected side information in records of 5 bytes, got " +
                std::to_string(records.size()) + " bytes");
  for (; !records.empty(); records.remove_prefix(kRecord)) {
    std::size_t offset = 0;
    for (int b = 0; b < 4; b++) offset = offset << 8 | std::uint8_t(records[b]);
    if (offset >= std::size_t(plane.width) * plane.height)
      header.fail(plane_name(i) + ": expected side information of " + std::to_string(plane.width) + "x" +
                  std::to_string(plane.height) + " texels, got offset " + std::to_string(offset));
    plane.at(int(offset / plane.width), int(offset % plane.width)) = std::uint8_t(records[4]);
  }
}

}  // namespace

void read_jpeg_planes(HeaderText& header, PtmBytes& out) {
  const std::size_t n = plane_count(out);
  const Plan plan = read_plan(header, n);
  for (std::size_t i = 0; i < n; i++)
    if (!may_hold_texels(plan.streams[i].size(), out.texels()))
      header.fail(plane_name(i) + ": expected a JPEG of " + std::to_string(out.width) + "x" +
                  std::to_string(out.height) + " texels, got " + std::to_string(plan.streams[i].size()) + " bytes");
  out.coefficients.resize(out.texels() * out.polynomials() * kPtmTerms);
  out.colour.resize(out.texels() * out.colours());
  const auto planes = planes_of(out);
  std::vector<std::string> faults(n);
  parallel_for(n, [&](std::size_t i) {
    try {
      decode_grey_jpeg(plan.streams[i], out.width, out.height, [&](int y, const std::uint8_t* row) {
        for (int x = 0; x < out.width; x++) planes[i].at(y, x) = row[x];
      });
    } catch (const std::runtime_error& error) {
      faults[i] = error.what();
    }
  });
  for (std::size_t i = 0; i < n; i++)
    if (!faults[i].empty()) header.fail(plane_name(i) + ": " + faults[i]);
  for (const int i : plan.sequence) {
    if (const int of = plan.reference[i]; of >= 0) predict(planes[i], planes[of], plan.transforms[i] & kInverted);
    correct(planes[i], plan.corrections[i], header, std::size_t(i));
  }
}

}  // namespace burnish
