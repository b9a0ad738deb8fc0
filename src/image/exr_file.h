#pragma once
/// \file
/// OpenEXR by parts: images that are read, and written, some rows at a time.

#include <cstddef>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "base/file.h"
#include "image/exr.h"
#include "image/image_file.h"

namespace gonio {

/// Image of a file, half and integer channels widened.  Of files in scan lines a part costs all columns of its rows.  Tiles of more than
/// 2²² pixels are refused.
std::unique_ptr<ImageFile> open_exr(const std::string& path);

struct ExrChannel {
  std::string name;
  Storage storage = Storage::single;
};

/// Image that is written from the top, some rows at a time; nothing of it stays in memory.
class ExrWriter {
 public:
  /// Lossless all.  Runs of equal bytes cost next to nothing; noise, which zip makes 6 % smaller, they leave as it is.
  enum class Packing { none, runs, zip };

  /// \param out      outlives the writer; to be committed after finish()
  /// \param threads  that pack rows
  ExrWriter(OutputFile& out,
            std::size_t width,
            std::size_t height,
            std::vector<ExrChannel> channels,
            const std::map<std::string, std::string>& attributes,
            Packing packing = Packing::zip,
            int threads = 0);
  ~ExrWriter();
  ExrWriter(const ExrWriter&) = delete;
  ExrWriter& operator=(const ExrWriter&) = delete;

  /// The next rows.  A value that half cannot hold is refused.  \param planes  by channel, rows × width
  void write(std::size_t rows, std::span<const float* const> planes);
  /// After the last row.
  void finish();

 private:
  class Inside;
  std::unique_ptr<Inside> inside_;
};

}  // namespace gonio
