#pragma once
/// \file
/// Directions of lamps from the highlights on a mirror ball that lies beside the surface.

#include <string>

#include "geometry/direction.h"
#include "image/image_file.h"
#include "stack/stack.h"

namespace gonio {

/// A ball as the images show it [pixels]: its middle, from their left and top edges, and its radius.
struct MirrorBall {
  double x = 0, y = 0, radius = 0;
};

/// Direction of the lamp that a ball in an image mirrors, seen from straight above by a camera that is far away.
///
/// The lamp's pixels are those around the brightest that have half of its light and touch each other, and their neighbours. Each shows the direction
/// r = 2 (n·v) n − v. The lamp's is their mean by light beyond the ball's median, since all pixels of a ball show solid angles of one size.
/// \throws Error  bad_input of a ball that is not within the image, or shows no small highlight, or one of a lamp below the surface
Direction lamp_of_ball(ImageFile&, const MirrorBall&);

/// Stack of all images in a folder, by their names' order, each with its lamp as its ball shows it.
/// \param stack   path of the document to be
/// \param linear  said of images that do not say that their numbers are light
/// \param others  files of the folder that are no images of the stack
Stack stack_of_ball(const std::string& folder,
                    const MirrorBall&,
                    const std::string& stack,
                    bool linear,
                    const std::vector<std::string>& others);

}  // namespace gonio
