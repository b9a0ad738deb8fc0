#include "brdf/model/own_files.h"

#include <algorithm>
#include <filesystem>

#include "base/error.h"
#include "base/file.h"
#include "brdf/model/model.h"
#include "brdf/model/spec.h"
#include "foreign/function.h"

namespace gonio {
namespace {

std::string with_file(const std::string& name, const auto& path_of) {
  auto n = foreign::parse_name(name);
  n.file = path_of(n.file);
  return foreign::text_of(n);
}

/// True of a file, and of a text that was given in its place.
bool is_file(const std::string& path) {
  std::error_code unknown;
  if (std::filesystem::exists(path, unknown)) return true;
  try {
    return !foreign::sha256_of(path).empty();
  } catch (const Error&) {
    return false;
  }
}

[[noreturn]] void refuse_missing(const std::string& document, const std::string& file) {
  throw bad_input(document, "model", file + ", which is not beside it",
                  "a copy of that shader there");
}

}  // namespace

std::string with_own_names(std::string_view spec,
                           const std::function<std::string(const std::string& name)>& change,
                           const std::string& document) {
  // Most specs name no file, and a preset is no spec.
  if (spec.find('.') == spec.npos) return std::string(spec);
  auto model = parse_model(spec, document);
  each_name(model, [&](std::string& name) {
    if (foreign::is_name(name)) name = change(name);
  });
  return to_text(model);
}

bool names_own_file(std::string_view spec) {
  bool any = false;
  try {
    with_own_names(spec, [&](const std::string& name) {
      any = true;
      return name;
    });
  } catch (const Error&) {
    // No model: whoever reads it says where that stands.
  }
  return any;
}

std::string own_files_beside(const std::string& document, const std::string& spec) {
  return with_own_names(
      spec,
      [&](const std::string& name) {
        return with_file(name, [&](const std::string& file) {
          auto path = path_beside(document, file);
          if (!is_file(path)) refuse_missing(document, file);
          return path;
        });
      },
      document);
}

std::string own_files_of_fit(const std::string& document, const std::string& spec) {
  const auto path_of = [&](const std::string& file) {
    const auto beside = path_beside(document, file);
    if (is_file(beside)) return beside;
    if (!is_file(file)) refuse_missing(document, file);
    try {
      path_beside(document, std::filesystem::absolute(file).string());
    } catch (const Error&) {
      throw bad_input(document, "model", file, "a shader beside the document, or --follow-paths");
    }
    return file;
  };
  const auto change = [&](const std::string& name) { return with_file(name, path_of); };
  try {
    return with_own_names(spec, change, document);
  } catch (const Error& e) {
    if (e.code() != Exit::usage) throw;
    if (!names_own_file(spec)) return spec;  // no model: whoever reads it says where that stands
    return with_own_names(spec, change);     // slashes of a path that leads to a file from here
  }
}

std::string model_of_file(const std::string& file, const std::string& spec) {
  const std::string from_here = own_files_of_fit(file, spec);
  try {
    compose(from_here, 1);
  } catch (const Error& e) {  // the words are the file's, not the user's
    throw bad_input(file, "model", e.what(), "a model that can be evaluated");
  }
  return from_here;
}

std::string own_files_as_named(const std::string& document, const std::string& spec) {
  const auto folder = std::filesystem::path(document).parent_path();
  if (folder.empty()) return spec;
  return with_own_names(spec, [&](const std::string& name) {
    return with_file(name, [&](const std::string& file) {
      const auto below = std::filesystem::path(file).lexically_relative(folder);
      return below.empty() ? file : below.string();
    });
  });
}

std::vector<OwnFile> own_files(const std::vector<std::string>& specs, const std::string& document) {
  std::vector<OwnFile> all;
  for (const auto& spec : specs) try {
      with_own_names(
          spec,
          [&](const std::string& name) {
            const auto file = foreign::parse_name(name).file;
            if (std::ranges::find(all, file, &OwnFile::file) == all.end())
              all.push_back({file, foreign::sha256_of(
                                       document.empty() ? file : path_beside(document, file))});
            return name;
          },
          document);
    } catch (const Error&) {
      continue;  // as above
    }
  return all;
}

}  // namespace gonio
