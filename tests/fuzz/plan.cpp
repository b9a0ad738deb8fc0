// Any bytes as the plan of a scene.
#include "fuzz/one_file.h"
#include "scene/plan/document.h"
#include "scene/plan/scenes.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace gonio::scene;
  static const Scene scene = test::sphere(test::car_paint(), test::front());
  static const auto looks = looks_of(scene);
  return gonio::fuzz::read_as_file(data, size, [](const std::string& path) {
    const auto planned = read_plan(path, scene, looks);
    if (planned.by_material.size() != 1) std::abort();
    looks[0].surface(planned.by_material[0].value_or(looks[0].exact()));
  });
}
