#pragma once
/// \file
/// People's own files that a spec names: those that a document names lie beside it, and answers tell which bytes they had.

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "base/describe.h"

namespace gonio {

/// File that a spec takes a function from.
struct OwnFile {
  std::string file, sha256;  ///< as it is named, and of its bytes
};
template <>
inline constexpr auto description<OwnFile> =
    FieldList{Field{"file", &OwnFile::file, "as the model names it"},
              Field{"sha256", &OwnFile::sha256, "of the file's bytes"}};
/// What documents call the list of them.
inline constexpr std::string_view own_files_key = "shaders",
                                  own_files_meaning =
                                      "files that the models take functions from; left out where "
                                      "there are none";

/// True of a spec with a function of a file in it.
bool names_own_file(std::string_view spec);
/// The spec with each name of a file's function changed.
/// \param document  file that the spec stands in; "": it comes from a person
std::string with_own_names(std::string_view spec,
                           const std::function<std::string(const std::string& name)>& change,
                           const std::string& document = {});
/// The spec of a document with the paths of its files as the working folder sees them.
/// \throws Error  bad input of the document where a file lies outside its folder, unless follow_paths() was called
std::string own_files_beside(const std::string& document, const std::string& spec);
/// The spec of a fit's document with the paths of its files as the working folder sees them: beside the document; with follow_paths()
/// also as the working folder of the fit saw them, where there is none beside it.
/// \throws Error  bad input of the document where a file lies elsewhere, unless follow_paths() was called
std::string own_files_of_fit(const std::string& document, const std::string& spec);
/// The same of a file that has a spec among its texts, as a map.
/// \throws Error  bad input of the file also where that is no model
std::string model_of_file(const std::string& file, const std::string& spec);
/// The same spec back as the document has it: without the document's folder.
std::string own_files_as_named(const std::string& document, const std::string& spec);
/// The files of some specs, each once.  A spec that is none has none.
/// \param document  file that the specs stand in; "": they name files as the working folder sees them
std::vector<OwnFile> own_files(const std::vector<std::string>& specs,
                               const std::string& document = {});

}  // namespace gonio
