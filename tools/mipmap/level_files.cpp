#include "burnish/core/error.h"
#include "burnish/core/mip.h"
#include "mipmap/mipmap.h"

namespace burnish::cli {

std::string level_name(const std::string& pattern, int level, const std::string& option) {
  const std::size_t percent = pattern.find('%'), d = pattern.find('d', percent);
  const std::string width = d == std::string::npos ? "?" : pattern.substr(percent + 1, d - percent - 1);
  if (width.size() > 2 || width.find_first_not_of("0123456789") != std::string::npos ||
      pattern.find('%', percent + 1) != std::string::npos)
    throw CLI::ValidationError(option, "expected a name with one %d for the level, got '" + pattern + "'");
  std::string number = std::to_string(level);
  if (!width.empty() && number.size() < std::size_t(std::stoi(width)))
    number.insert(0, std::stoi(width) - number.size(), width[0] == '0' ? '0' : ' ');
  return pattern.substr(0, percent) + number + pattern.substr(d + 1);
}

LevelFiles::LevelFiles(Tool& tool, const ImageOutput& output, int levels)
    : type_(output.type()), sample_(output.sample()), levels_(levels), files_{tool.write(output.path)} {
  if (type_ != FileType::kExr && levels > 1)
    throw file_error(ErrorKind::kUnsupported, files_[0].name,
                     std::string(burnish::name(type_)) + " holds one level, not " + std::to_string(levels) +
                         " (EXR holds all; --split writes one file a level)");
}

LevelFiles::LevelFiles(Tool& tool, const std::string& pattern, const std::string& option, const ImageOutput& output,
                       int levels)
    : type_(output.as.type_of(level_name(pattern, 0, option), option)),
      sample_(output.sample_or(default_sample_type(type_))),
      levels_(levels) {
  require_can_hold(type_, sample_, level_name(pattern, 0, option));
  for (int l = 0; l < levels; l++) files_.push_back(tool.write(level_name(pattern, l, option)));
}

void LevelFiles::open(int width, int height, int channels, const Attributes& attributes) {
  if (int(files_.size()) < levels_) {
    chain_.emplace(files_[0], sample_, width, height, channels, levels_, attributes);
    return;
  }
  for (int l = 0; l < levels_; l++)
    parts_.emplace_back(files_[l], type_, sample_, level_size(width, l), level_size(height, l), channels, attributes);
}

void LevelFiles::write_rows(int level, const Image& rows) {
  if (chain_) chain_->write_rows(level, rows.height, rows.data.data());
  else parts_[level].write_rows(rows.height, rows.data.data());
}

void LevelFiles::close() {
  if (chain_) chain_->close();
  for (ImageWriter& part : parts_) part.close();
}

}  // namespace burnish::cli
