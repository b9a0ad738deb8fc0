#include "stack/parameter_image.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace gonio {

std::vector<std::string> names_of_values(const Model& model) {
  std::vector<std::string> names(model.value_count);
  for (const auto& p : model.parameters)
    for (std::size_t k = 0; k < p.count; ++k)
      names[p.first + k] = p.count == 1 ? p.name : p.name + "." + std::string(1, "RGB"[k]);
  return names;
}

ParameterImage::ParameterImage(const BoundModel& b, const std::optional<std::string>& path)
    : model_(b) {
  about_.resize(b.values.size());
  for (const auto& p : b.model.parameters)
    for (std::size_t k = 0; k < p.count; ++k) about_[p.first + k] = p.about;
  if (!path) return;
  file_ = open_image(*path);
  const auto names = names_of_values(b.model);
  const auto& there = file_->channels();
  std::vector<bool> used(there.size());
  for (std::size_t v = 0; v < names.size(); ++v)
    for (const auto& name : {names[v], names[v].substr(0, names[v].rfind('.'))}) {
      const auto at = std::ranges::find(there, name);
      if (at == there.end()) continue;
      const auto channel = static_cast<std::size_t>(at - there.begin());
      used[channel] = true;
      channels_.push_back(channel);
      values_.push_back(v);
      break;
    }
  const auto is_of_a_map = [](const std::string& name) {
    return name.find(".std_error") != name.npos || name.find(".status") != name.npos ||
           name.starts_with("normal.") || name == "rms" || name == "misfit" || name == "outcome";
  };
  for (std::size_t c = 0; c < there.size(); ++c)
    if (!used[c] && !is_of_a_map(there[c]))
      throw bad_input(*path, "channels", there[c],
                      fmt::format("parameters of the model: {}", fmt::join(names, ", ")));
  if (channels_.empty())
    throw bad_input(*path, "channels", fmt::format("{}", fmt::join(there, ", ")),
                    fmt::format("parameters of the model: {}", fmt::join(names, ", ")));
}

void ParameterImage::read(const Rectangle& part, std::vector<std::vector<float>>& to) {
  to.resize(model_.values.size());
  std::vector<float*> planes;
  for (auto& plane : to) {
    plane.resize(part.size());
    planes.push_back(plane.data());
  }
  for (std::size_t v = 0; v < planes.size(); ++v)
    std::fill_n(planes[v], part.size(), static_cast<float>(model_.values[v]));
  if (!file_) return;
  std::vector<float*> into;
  for (const std::size_t v : values_) into.push_back(planes[v]);
  file_->read(part, channels_, into);
  for (const std::size_t v : values_)
    for (std::size_t t = 0; t < part.size(); ++t) {
      const auto value = static_cast<double>(to[v][t]);
      if (std::isnan(value) || about_[v]->legal.holds(value)) continue;
      throw bad_input(
          file_->path(),
          fmt::format("column {}, row {}", part.x + t % part.width, part.y + t / part.width),
          fmt::format("{} = {:g}", about_[v]->name, value),
          fmt::format("{:g} to {:g}", about_[v]->legal.low, about_[v]->legal.high));
    }
}

}  // namespace gonio
