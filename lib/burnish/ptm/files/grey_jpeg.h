// One plane of bytes as a grey JPEG stream in memory.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

namespace burnish {

inline constexpr int kLargestJpegSide = 65500;  // libjpeg's

// Whether a stream of that many bytes can hold so many texels: coded with Huffman's codes it has at least a bit for
// each 8x8 of them. Asked before memory is set aside for what a header claims.
bool may_hold_texels(std::size_t stream_bytes, std::size_t texels);

// Gives `row` each row, of `width` bytes, from the stream's first on. Throws std::runtime_error, with what is wrong,
// for a stream that is damaged, cut short, of another size or coded otherwise.
void decode_grey_jpeg(std::string_view stream, int width, int height,
                      const std::function<void(int y, const std::uint8_t* row)>& row);

// `row` fills a row of the stream. Every frequency is rounded to multiples of `step`, 1 … 255: libjpeg's own tables are
// for eyes, which do not look at these planes.
std::string encode_grey_jpeg(int width, int height, int step, const std::function<void(int y, std::uint8_t* row)>& row);

}  // namespace burnish
