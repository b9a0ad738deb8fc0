#pragma once
/// \file
/// Lists of lamps, as domes and mirror balls give them: the beginning of a stack for those who have photographs.

#include <optional>
#include <string>

#include "stack/stack.h"

namespace gonio {

/// Stack of the images that a list of lamps names, seen from straight above.
///
/// The list is that of reflectance transformation imaging, .lp: a count, then a line for each image with its name and the vector to its lamp, x to the right,
/// y upwards in the image, z towards the camera [PTMfitter and RTIBuilder write it].  The images are looked for in a folder by their names, whatever folder the list
/// has before them, then by their names with another of gonio's endings: a list of the camera's .jpg serves for .png that were developed from the raw files.
///
/// \param images  folder of the images; empty: that of the list
/// \param stack   path of the document to be, to which paths are relative
/// \throws Error  bad_input of a line, by its number; of an image that is not there, or not below the folder of the stack
Stack stack_of_lamps(const std::string& list, const std::string& images, const std::string& stack);

/// Whether a name ends as those of images do.
bool is_image_name(const std::string& name);
/// Path of a file relative to the folder of a stack, where documents name it; one that lies elsewhere is refused.
/// \param list, place  who names it
std::string name_in_stack(const std::string& file,
                          const std::string& stack,
                          const std::string& list,
                          const std::string& place);

}  // namespace gonio
