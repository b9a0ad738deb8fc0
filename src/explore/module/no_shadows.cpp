// What a page has not: objects that cast shadows. No light of it is asked for any.
#include "scene/trace/tracer.h"

namespace gonio::scene {

bool Tracer::occluded(const Vector&, const Direction&, const Direction&, double) const {
  return false;
}

}  // namespace gonio::scene
