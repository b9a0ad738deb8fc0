#include "stack/lamps.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <set>
#include <string_view>

#include "base/blanks.h"
#include "base/error.h"
#include "base/file.h"
#include "base/numbers.h"
#include "base/text.h"

#include <fmt/format.h>

namespace gonio {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t most_list_bytes = 1 << 22;
constexpr std::array endings{".exr", ".npy", ".png", ".tif", ".tiff"};

/// Takes the last word of a line; empty where there is none.
std::string_view last_word(std::string_view& line) {
  const auto end = line.find_last_not_of(blanks);
  if (end == line.npos) return {};
  line = line.substr(0, end + 1);
  const auto before = line.find_last_of(blanks);
  const auto word = line.substr(before == line.npos ? 0 : before + 1);
  line = line.substr(0, line.size() - word.size());
  return word;
}

/// The image of a name in a folder, or one that differs from it by its ending.
fs::path image_in(const fs::path& folder, const std::string& name) {
  std::error_code none;
  const fs::path as_named = folder / name;
  if (is_image_name(name) && fs::exists(as_named, none)) return as_named;
  for (const char* ending : endings)
    if (const fs::path other = fs::path(as_named).replace_extension(ending);
        fs::exists(other, none))
      return other;
  return as_named;
}

}  // namespace

bool is_image_name(const std::string& name) {
  return std::ranges::find(endings, fs::path(name).extension()) != endings.end();
}

std::string name_in_stack(const std::string& file,
                          const std::string& stack,
                          const std::string& list,
                          const std::string& place) {
  const fs::path beside = fs::path(stack).parent_path();
  const fs::path relative = fs::proximate(file, beside.empty() ? fs::path(".") : beside);
  if (relative.is_absolute() || *relative.begin() == "..")
    throw bad_input(list, place, printable(file, 100),
                    "an image below the folder of the stack: write that beside the images");
  return relative.generic_string();
}

Stack stack_of_lamps(const std::string& list, const std::string& images, const std::string& path) {
  const std::string text = InputFile(list).read_rest(most_list_bytes);
  const fs::path folder = images.empty() ? fs::path(list).parent_path() : fs::path(images);
  Stack s;
  s.path = path;
  s.values = StackValues::f_r_cosine;
  std::optional<std::size_t> count;
  std::set<std::string> files;
  std::size_t number = 0;
  for (std::string_view line : split(std::string_view(text), '\n')) {
    ++number;
    if (trimmed(line).empty()) continue;
    const auto place = fmt::format("line {}", number);
    if (!count) {
      count = number_from<std::size_t>(trimmed(line));
      if (!count || *count == 0 || *count > 10'000)
        throw bad_input(list, place, printable(line, 60), "the number of images, 1 to 10 000");
      continue;
    }
    const std::string whole = printable(line, 60);
    std::array<double, 3> towards{};
    for (std::size_t k = 3; k-- > 0;) {
      const auto x = number_from<double>(last_word(line));
      if (!x || !std::isfinite(*x) || std::abs(*x) > 1e9)
        throw bad_input(list, place, whole, "a name and three numbers, the vector to the lamp");
      towards[k] = *x;
    }
    if (!(towards[2] > 0))
      throw bad_input(list, place, fmt::format("z = {:g}", towards[2]),
                      "a lamp above the surface: z towards the camera, above 0");
    std::string name(trimmed(line));
    name = name.substr(name.find_last_of("/\\") + 1);  // of the npos that it may be: from 0
    if (name.empty()) throw bad_input(list, place, whole, "a name before the numbers");
    const fs::path file = image_in(folder, name);
    if (std::error_code none; !fs::exists(file, none))
      throw bad_input(list, place,
                      fmt::format("{}, which is not there", printable(file.string(), 100)),
                      "an image of that name that ends in .exr, .npy, .png or .tif");
    const std::string in_stack = name_in_stack(file.string(), path, list, place);
    if (!files.insert(in_stack).second)
      throw bad_input(list, place, printable(in_stack, 60), "each image once");
    StackImage& image = s.images.emplace_back();
    image.path = in_stack;
    image.light = SideVector<Side::light>{{towards[0], towards[1], towards[2]}};
    image.view = SideVector<Side::view>{{0, 0, 1}};
  }
  if (!count) throw bad_input(list, "line 1", "nothing", "the number of images");
  if (*count != s.images.size())
    throw bad_input(list, "line 1", fmt::format("{} images", *count),
                    fmt::format("{}, as many as follow", s.images.size()));
  return s;
}

}  // namespace gonio
