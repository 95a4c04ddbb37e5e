#include "burnish/palette/files/exr_file.h"

#include <ImfChannelList.h>
#include <ImfFloatVectorAttribute.h>
#include <ImfInputFile.h>
#include <ImfIntAttribute.h>
#include <ImfOutputFile.h>
#include <ImfStringAttribute.h>
#include <ImfThreading.h>

#include "burnish/core/parallel.h"
#include "burnish/palette/files/indexed_files.h"

namespace burnish::detail {

void use_exr_threads() { Imf::setGlobalThreadCount(thread_limit() > 1 ? thread_limit() : 0); }

void insert_palette(Imf::Header& header, const Palette& palette) {
  std::vector<float> flat;
  flat.reserve(palette.normals.size() * 3);
  for (const Vec3f& n : palette.normals) flat.insert(flat.end(), {n.x, n.y, n.z});
  header.insert("burnish:palette", Imf::FloatVectorAttribute(flat));
  header.insert("burnish:materials", Imf::StringAttribute(materials_to_json(palette.materials)));
  header.insert("burnish:space", Imf::StringAttribute(name(palette.space)));
  header.insert("burnish:y", Imf::StringAttribute("up"));
  header.insert("burnish:format", Imf::IntAttribute(1));
  header.compression() = Imf::ZIP_COMPRESSION;
  header.zipCompressionLevel() = 2;  // of indices, higher levels save 4 % and cost half as much time again
}

Palette extract_palette(const Imf::Header& header, const FileRef& file) {
  const auto* flat = header.findTypedAttribute<Imf::FloatVectorAttribute>("burnish:palette");
  const auto* materials = header.findTypedAttribute<Imf::StringAttribute>("burnish:materials");
  if (!flat || flat->value().size() % 3 != 0)
    throw file_error(ErrorKind::kMalformed, file.name,
                     "expected a palette of normals in the attribute burnish:palette");
  const auto* format = header.findTypedAttribute<Imf::IntAttribute>("burnish:format");
  if (format && format->value() != 1)
    throw file_error(ErrorKind::kUnsupported, file.name,
                     "expected burnish:format 1, got " + std::to_string(format->value()));
  Palette palette;
  for (std::size_t i = 0; i < flat->value().size(); i += 3)
    palette.normals.push_back({flat->value()[i], flat->value()[i + 1], flat->value()[i + 2]});
  palette.materials = materials ? materials_from_json(materials->value(), file.name)
                                : std::vector<MaterialInterval>{{0, 0, int(palette.normals.size())}};
  if (const auto* space = header.findTypedAttribute<Imf::StringAttribute>("burnish:space"))
    palette.space = space_from_name(space->value(), file.name);
  if (const auto* y = header.findTypedAttribute<Imf::StringAttribute>("burnish:y")) require_y_up(y->value(), file.name);
  validate(palette, file.name);
  return palette;
}

Imf::FrameBuffer frame_buffer(std::vector<std::uint32_t>& data, int width, int first_row) {
  Imf::FrameBuffer buffer;
  char* base = reinterpret_cast<char*>(data.data()) - sizeof(std::uint32_t) * std::ptrdiff_t(first_row) * width;
  buffer.insert(kIndexChannel, Imf::Slice(Imf::UINT, base, sizeof(std::uint32_t), sizeof(std::uint32_t) * width));
  return buffer;
}

std::optional<Palette> read_palette_exr(const FileRef& file) {
  return reading_exr(file, [&]() -> std::optional<Palette> {
    const Imf::InputFile in(file.path.c_str());
    if (!in.header().findTypedAttribute<Imf::FloatVectorAttribute>("burnish:palette")) return std::nullopt;
    return extract_palette(in.header(), file);
  });
}

void write_palette_exr(const FileRef& file, const Palette& palette) {
  const int n = int(palette.normals.size());
  Imf::Header header(n, 1);
  for (const char* channel : {"R", "G", "B"}) header.channels().insert(channel, Imf::Channel(Imf::FLOAT));
  insert_palette(header, palette);
  Imf::FrameBuffer buffer;
  char* base = reinterpret_cast<char*>(const_cast<Vec3f*>(palette.normals.data()));
  for (int c = 0; c < 3; c++)
    buffer.insert(std::string(1, "RGB"[c]),
                  Imf::Slice(Imf::FLOAT, base + c * sizeof(float), sizeof(Vec3f), sizeof(Vec3f) * n));
  use_exr_threads();
  ExrStream stream(file);
  stream.guard([&] {
    Imf::OutputFile out(stream, header);
    out.setFrameBuffer(buffer);
    out.writePixels(1);
  });
  stream.close();
}

}  // namespace burnish::detail
