#include "burnish/ptm/photos/capture.h"

#include <sys/resource.h>

#include <algorithm>

#include "burnish/core/error.h"
#include "burnish/core/parallel.h"

namespace burnish {
namespace {

// Two bands are held. Larger ones are not faster; they leave the caches.
constexpr std::size_t kMostBandBytes = 12 << 20;
constexpr std::size_t kSpillBytes = 4 << 20;

// Every photograph is open at once, and some systems let a process open a thousand files unless it asks for more.
void allow_open_files(std::size_t files) {
  rlimit limit{};
  const rlim_t wanted = rlim_t(files) + 64;
  if (::getrlimit(RLIMIT_NOFILE, &limit) != 0 || limit.rlim_cur >= wanted) return;
  limit.rlim_cur = std::min(wanted, limit.rlim_max);
  ::setrlimit(RLIMIT_NOFILE, &limit);  // where that is too few, opening fails
}

std::string size_text(const PhotoForm& f) { return std::to_string(f.width) + "x" + std::to_string(f.height); }

}  // namespace

Capture::Capture(std::vector<FileRef> photos, std::size_t memory, const std::string& directory) {
  allow_open_files(photos.size());
  for (FileRef& file : photos) {
    const PhotoForm form = open_photo(file)->form();
    if (!photos_.empty() && (form.width != width_ || form.height != height_))
      throw file_error(ErrorKind::kMalformed, file.name,
                       "expected " + size_text(photos_[0].form) + " texels as in '" + photos_[0].file.name + "', got " +
                           size_text(form));
    width_ = form.width, height_ = form.height;
    bytes_ = bytes_ && form.bytes;
    photos_.push_back({std::move(file), form});
  }
  const std::size_t row = std::size_t(width_) * 3 * photos_.size() * (bytes_ ? 1 : sizeof(float));
  band_rows_ = int(std::clamp<std::size_t>(std::min(kMostBandBytes, memory / 8) / std::max<std::size_t>(row, 1), 1,
                                           std::size_t(std::max(height_, 1))));
  spill(memory, directory);
}

void Capture::spill(std::size_t memory, const std::string& directory) {
  std::vector<Source*> whole;
  std::size_t size = 0;
  for (Source& s : photos_)
    if (s.form.whole) {
      s.spilled_at = size;
      size += row_bytes(s) * height_;
      whole.push_back(&s);
    }
  if (whole.empty()) return;
  spilled_.emplace(directory);
  // What decoders hold of a texel: 16 bits a sample.
  const std::size_t decoder = std::size_t(width_) * height_ * 6, at_once = 2 * decoder <= memory ? 2 : 1;
  std::size_t next = 0;
  parallel_pipeline(
      at_once, [&] { return next < whole.size() ? std::make_shared<Source*>(whole[next++]) : nullptr; },
      [&](const std::shared_ptr<Source*>& of) {
        const Source& s = **of;
        const std::unique_ptr<Photo> photo = open_photo(s.file);
        const int band = int(std::clamp<std::size_t>(kSpillBytes / row_bytes(s), 1, std::size_t(height_)));
        std::vector<std::uint8_t> rows(row_bytes(s) * band);
        for (int first = 0; first < height_; first += band) {
          const int count = std::min(band, height_ - first);
          if (s.form.bytes) photo->read(count, rows.data());
          else photo->read(count, reinterpret_cast<float*>(rows.data()));
          spilled_->write(s.spilled_at + row_bytes(s) * first, rows.data(), row_bytes(s) * count);
        }
        return of;
      },
      [](const std::shared_ptr<Source*>&) {});
}

void Capture::read(const Source& s, Photo* photo, int first, int rows, std::uint8_t* bytes, float* floats) const {
  const std::size_t at = s.spilled_at + row_bytes(s) * first, samples = std::size_t(width_) * 3 * rows;
  if (!s.form.bytes) {
    if (photo) photo->read(rows, floats);
    else spilled_->read(at, floats, samples * sizeof(float));
    return;
  }
  std::vector<std::uint8_t> own;  // of a photograph of bytes among others of floats
  if (!bytes) own.resize(samples);
  std::uint8_t* to = bytes ? bytes : own.data();
  if (photo) photo->read(rows, to);
  else spilled_->read(at, to, samples);
  if (!bytes) std::copy_n(to, samples, floats);
}

void Capture::for_each_band(const std::function<void(const PhotoBand&)>& work, const Progress& progress) const {
  std::vector<std::unique_ptr<Photo>> open(photos_.size());
  for (std::size_t i = 0; i < photos_.size(); i++)
    if (!photos_[i].form.whole) open[i] = open_photo(photos_[i].file);
  constexpr std::size_t kBlock = PhotoBand::kBlockTexels * 3;
  const auto fill = [&](PhotoBand& band, int first) {
    band.first = first, band.rows = std::min(band_rows_, height_ - first);
    band.stride = (std::size_t(width_) * 3 * band_rows_ + kBlock - 1) / kBlock * kBlock;
    (bytes_ ? band.bytes.resize(band.stride * photos_.size()) : band.floats.resize(band.stride * photos_.size()));
    parallel_for(photos_.size(), [&](std::size_t i) {
      read(photos_[i], open[i].get(), first, band.rows, bytes_ ? band.bytes.data() + band.stride * i : nullptr,
           bytes_ ? nullptr : band.floats.data() + band.stride * i);
    });
  };
  PhotoBand now, next;
  fill(now, 0);
  while (now.rows > 0) {
    const int after = now.first + now.rows;
    next.rows = 0;
    parallel_invoke([&] { work(now); },
                    [&] {
                      if (after < height_) fill(next, after);
                    });
    report_progress(progress, double(after) / height_);
    std::swap(now, next);
  }
}

}  // namespace burnish
