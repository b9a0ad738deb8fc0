#include "data_synth/stack_synth.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <limits>
#include <memory>
#include <system_error>
#include <vector>

#include "base/error.h"
#include "base/file.h"
#include "base/random.h"
#include "brdf/model/evaluate.h"
#include "data_synth/synth.h"
#include "image/exr_file.h"
#include "image/image_file.h"
#include "image/npy.h"
#include "stack/parameter_image.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <tbb/parallel_for.h>

namespace gonio {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t rows_at_once = 16;
const std::array<std::string, 3> colours{"R", "G", "B"};

/// Planes of some rows.
using Planes = std::vector<std::vector<float>>;

std::vector<float*> pointers(Planes& planes, std::size_t texels) {
  std::vector<float*> p;
  for (auto& plane : planes) {
    plane.resize(texels);
    p.push_back(plane.data());
  }
  return p;
}

/// Images written row by row, of either format; all of them take their names at the end.
class RowsOut {
 public:
  RowsOut(const std::string& path,
          std::size_t width,
          std::size_t height,
          const std::vector<std::string>& channels,
          ImageFormat format,
          Storage storage)
      : out_(path, NamedBy::gonio), width_(width), channels_(channels.size()) {
    if (format == ImageFormat::npy) {
      out_.write(npy_header(channels_ == 1 ? std::vector{height, width}
                                           : std::vector{height, width, channels_}));
      return;
    }
    std::vector<ExrChannel> stored;
    for (const auto& name : channels) stored.push_back({name, storage});
    exr_ = std::make_unique<ExrWriter>(out_, width, height, stored,
                                       std::map<std::string, std::string>{});
  }
  void write(std::size_t rows, const Planes& planes) {
    if (exr_) {
      std::vector<const float*> p;
      for (const auto& plane : planes) p.push_back(plane.data());
      return exr_->write(rows, p);
    }
    std::vector<float> mixed(rows * width_ * channels_);
    for (std::size_t c = 0; c < channels_; ++c)
      for (std::size_t t = 0; t < rows * width_; ++t) mixed[t * channels_ + c] = planes[c][t];
    out_.write({reinterpret_cast<const char*>(mixed.data()), mixed.size() * sizeof(float)});
  }
  OutputFile& finish() {
    if (exr_) exr_->finish();
    return out_;
  }

 private:
  OutputFile out_;
  std::size_t width_, channels_;
  std::unique_ptr<ExrWriter> exr_;
};

std::vector<DirectionPair> pairs_of(const DirectionList& l) {
  std::vector<DirectionPair> pairs;
  for (std::size_t i = 0; i < l.theta_i_deg.size(); ++i)
    pairs.push_back({direction(l.theta_i_deg[i] * degree, l.phi_i_deg[i] * degree),
                     direction(l.theta_o_deg[i] * degree, l.phi_o_deg[i] * degree)});
  return pairs;
}

/// An image that the sizes of all others follow.
void expect_size(const ImageFile& file, std::size_t width, std::size_t height) {
  if (file.width() != width || file.height() != height)
    throw bad_input(file.path(), "size", fmt::format("{} × {}", file.width(), file.height()),
                    fmt::format("{} × {}", width, height));
}

}  // namespace

Stack synthesize_stack(const BoundModel& b, const StackSynthOptions& o, const std::string& folder) {
  const std::size_t channels = b.model.channels;
  if (channels != 1 && channels != 3)
    throw wrong_usage(
        fmt::format("a stack has 1 or 3 channels, the colours given have {}", channels));
  const DirectionList list = o.directions ? *o.directions : random_pairs(o.images, o.seed);
  const auto pairs = pairs_of(list);
  constexpr std::size_t most = 512;
  if (pairs.empty() || pairs.size() > most)
    throw wrong_usage(fmt::format("{} images; from 1 to {} are written", pairs.size(), most));

  ParameterImage parameters(b, o.parameters);
  std::unique_ptr<ImageFile> normals;
  if (o.normals) normals = open_image(*o.normals);
  if (normals && normals->channels().size() != 3)
    throw bad_input(*o.normals, "channels", fmt::format("{}", normals->channels().size()),
                    "three: X, Y and Z, or R, G and B");
  const ImageFile* sizes = parameters.file() ? parameters.file() : normals.get();
  const std::size_t width = sizes ? sizes->width() : o.width;
  const std::size_t height = sizes ? sizes->height() : o.height;
  if (normals) expect_size(*normals, width, height);
  // By name: R, G, B and X, Y, Z are in this order already, but OpenEXR sorts B, G, R.
  std::vector<std::size_t> axes{0, 1, 2};
  if (normals && normals->channels()[0] == "B") axes = {2, 1, 0};

  std::error_code failed;
  fs::create_directories(folder, failed);
  if (failed && !fs::is_directory(folder))
    throw bad_input(folder, "writing", failed.message(), "a folder that can be written");
  const auto path_in = [&](const std::string& name) { return (fs::path(folder) / name).string(); };

  Stack stack;
  stack.path = path_in("stack.json");
  stack.values = o.values;
  if (normals) stack.normals = "normals.exr";
  stack.truth = StackTruth{to_text(b.model.spec), "parameters.exr", o.noise, o.seed};
  const std::vector<std::string> names =
      channels == 1 ? std::vector<std::string>{"Y"} : std::vector(colours.begin(), colours.end());
  std::vector<std::unique_ptr<RowsOut>> files;
  const auto begin_file = [&](const std::string& name, const std::vector<std::string>& of,
                              ImageFormat format, Storage storage) {
    files.push_back(std::make_unique<RowsOut>(path_in(name), width, height, of, format, storage));
  };
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    StackImage& image = stack.images.emplace_back();
    image.path = fmt::format("image_{:03}.{}", i, name_of(o.format));
    image.light = SideAngles<Side::light>{list.theta_i_deg[i], list.phi_i_deg[i]};
    image.view = SideAngles<Side::view>{list.theta_o_deg[i], list.phi_o_deg[i]};
    begin_file(image.path, names, o.format, o.storage);
  }
  begin_file("parameters.exr", names_of_values(b.model), ImageFormat::exr, Storage::single);
  if (normals) begin_file("normals.exr", {"X", "Y", "Z"}, ImageFormat::exr, Storage::single);
  OutputFile document(stack.path, NamedBy::gonio);
  document.write(to_json(stack));

  std::vector<Planes> images(pairs.size(), Planes(channels));
  Planes values, normal(3);
  for (std::size_t y = 0; y < height; y += rows_at_once) {
    const Rectangle part{0, y, width, std::min(rows_at_once, height - y)};
    parameters.read(part, values);
    if (normals) normals->read(part, axes, pointers(normal, part.size()));
    for (auto& planes : images) pointers(planes, part.size());
    tbb::parallel_for(std::size_t{0}, part.height, [&](std::size_t row) {
      BoundModel here = b;
      std::vector<FrameAngles<double>> angles(pairs.size());
      for (std::size_t t = row * width; t < (row + 1) * width; ++t) {
        bool is_known = true;
        for (std::size_t v = 0; v < values.size(); ++v) {
          here.values[v] = static_cast<double>(values[v][t]);
          is_known = is_known && !std::isnan(here.values[v]);
        }
        Direction n;
        if (normals) {
          const Vector given{static_cast<double>(normal[0][t]), static_cast<double>(normal[1][t]),
                             static_cast<double>(normal[2][t])};
          is_known = is_known && length(given) > 0 && given.z > 0;
          if (is_known) n = direction(given);
        }
        for (std::size_t i = 0; i < pairs.size(); ++i)
          angles[i] = frame_angles(normals ? within(pairs[i], n) : pairs[i]);
        std::vector<std::vector<double>> f;
        if (is_known) f = evaluate(here, angles);
        for (std::size_t i = 0; i < pairs.size(); ++i) {
          Draws draw(o.seed, y * width + t, i);
          const double cosine =
              o.values == StackValues::f_r_cosine ? std::max(angles[i].nol, 0.0) : 1;
          for (std::size_t c = 0; c < channels; ++c) {
            double value = is_known ? f[c][i] * cosine : std::numeric_limits<double>::quiet_NaN();
            if (o.noise > 0) value *= std::exp(o.noise * draw.normal());
            images[i][c][t] = static_cast<float>(value);
          }
        }
      }
    });
    for (std::size_t i = 0; i < images.size(); ++i) files[i]->write(part.height, images[i]);
    files[images.size()]->write(part.height, values);
    if (normals) files.back()->write(part.height, normal);
  }
  std::vector<OutputFile*> all;
  for (auto& f : files) all.push_back(&f->finish());
  all.push_back(&document);
  commit_all(all);
  return stack;
}

}  // namespace gonio
