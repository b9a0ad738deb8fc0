#pragma once
/// \file
/// Image of a model's parameters: a channel for each of its values, as gonio's own maps have them.

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "brdf/model/model.h"
#include "image/image_file.h"

namespace gonio {

/// Where a model's values stand in an image of its parameters: "alpha", "kd.R".
std::vector<std::string> names_of_values(const Model&);

/// Parameters of each texel: those of an image where it has them, else those of a model.
class ParameterImage {
 public:
  /// \param model  outlives it
  /// \param path   none: all texels are as the model
  /// \throws Error  bad_input of a channel that neither the model nor a map of gonio's has
  ParameterImage(const BoundModel& model, const std::optional<std::string>& path);
  /// None where there is no image.
  const ImageFile* file() const { return file_.get(); }

  /// Values of a part's texels, a plane for each value of the model.  One that the model does not take is refused by its column and row.
  void read(const Rectangle& part, std::vector<std::vector<float>>& to);

 private:
  const BoundModel& model_;
  std::vector<const Parameter*> about_;
  std::unique_ptr<ImageFile> file_;
  std::vector<std::size_t> channels_, values_;
};

}  // namespace gonio
