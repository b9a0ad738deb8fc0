#include "stack/stack.h"

#include <algorithm>

#include "base/file.h"
#include "base/json/describe.h"

namespace gonio {

/// Keys of a side: "theta_i" of the incident light, "theta_o" of the view.
template <Side side>
struct SideKeys {
  static constexpr bool light = side == Side::light;
  static constexpr std::string_view theta = light ? "theta_i" : "theta_o",
                                    phi = light ? "phi_i" : "phi_o",
                                    vector = light ? "light" : "view",
                                    map = light ? "light_map" : "view_map",
                                    position = light ? "light_position" : "view_position";
};

template <Side side>
struct Description<SideAngles<side>> {
  static constexpr auto fields() {
    return FieldList{field(SideKeys<side>::theta, "°", &SideAngles<side>::theta_deg,
                           "angle of all texels from the normal", Numbers{0, 90, false, true}),
                     field(SideKeys<side>::phi, "°", &SideAngles<side>::phi_deg,
                           "azimuth from x towards y", Numbers{-360, 360}, or_default)};
  }
};
template <Side side>
struct Description<SideVector<side>> {
  static constexpr auto fields() {
    constexpr double far = 1e9;
    return FieldList{field(SideKeys<side>::vector, &SideVector<side>::towards,
                           "vector of all texels, of any length but 0, z above 0",
                           Numbers{-far, far})};
  }
  static void check(SideVector<side>& v, Demand expect) {
    expect(v.towards.z > 0, SideKeys<side>::vector, "a direction above the surface: z above 0");
  }
};
template <Side side>
struct Description<SideMap<side>> {
  static constexpr auto fields() {
    return FieldList{field(SideKeys<side>::map, &SideMap<side>::path,
                           "path of an image with a vector for each texel", not_empty)};
  }
};
template <Side side>
struct Description<SidePosition<side>> {
  static constexpr auto fields() {
    constexpr double far = 1e9;
    return FieldList{field(SideKeys<side>::position, &SidePosition<side>::at,
                           "place from the middle of the image, z above the surface, in the unit "
                           "of \"width\"",
                           Numbers{-far, far})};
  }
  static void check(SidePosition<side>& p, Demand expect) {
    expect(p.at.z > 0, SideKeys<side>::position, "a place above the surface: z above 0");
  }
};
template <>
inline constexpr auto description<StackImage> = FieldList{
    Field{"path", &StackImage::path,
          "of an OpenEXR file, an array of NumPy's, a PNG of 16 bits or a TIFF, linear", not_empty},
    by_key(&StackImage::light), by_key(&StackImage::view),
    Field{"scale", &StackImage::scale, "what its numbers are multiplied with",
          Numbers{0, 1e30, true}, or_default}};
template <>
inline constexpr auto description<StackTruth> = FieldList{
    Field{"model", &StackTruth::model, "that was evaluated", not_empty},
    Field{"parameters", &StackTruth::parameters,
          "path of an image with a channel for each parameter", not_empty},
    Field{"noise", &StackTruth::noise,
          "values were multiplied by exp(noise · z), z standard normal", Numbers{0, 5}, or_default},
    Field{"seed", &StackTruth::seed, "of the noise", or_default}};
template <>
struct Description<Stack> {
  static constexpr auto fields() {
    return FieldList{
        constant_text("schema", "gonio.stack/1"),
        field("values", "1/sr", &Stack::values, "what the images hold", or_default),
        field("channels", if_there(&Stack::channels),
              "of each image, one or three; else R, G and B, or the only one it has", Entries{1, 3},
              not_empty),
        field("normals", if_there(&Stack::normals),
              "path of an image with the normal of each texel, linear in [-1, 1]", not_empty),
        field("width", if_there(&Stack::width),
              "of the surface that the images show, in the unit of positions", Numbers{1e-9, 1e9}),
        field(
            "heights", if_there(&Stack::heights),
            "path of an image of one channel, the surface's heights in that unit; else it is flat",
            not_empty),
        field("saturation", if_there(&Stack::saturation),
              "number of the images from which on light is clipped, and left out",
              Numbers{0, 1e30, true}),
        field("floor", if_there(&Stack::floor),
              "number of the images up to which there is shadow or noise, left out",
              Numbers{0, 1e30}),
        field(
            "dark", if_there(&Stack::dark),
            "path of a photograph without light, whose numbers are taken from those of all others",
            not_empty),
        field(
            "flat", if_there(&Stack::flat),
            "path of a photograph of a white sheet under even light: all others are divided by it "
            "over its middle",
            not_empty),
        field("linear", &Stack::linear,
              "images in PNG and TIFF are light, though they do not say so (gAMA 1, "
              "TransferFunction)",
              or_default),
        field("images", &Stack::images, "one for each pair of light and view", Entries{1, 10'000}),
        field("truth", if_there(&Stack::truth), "what gonio made the stack from")};
  }
  static void check(Stack& s, Demand expect) {
    expect(!s.channels || s.channels->size() != 2, "channels", "an array of 1 or 3");
    const bool is_near = std::ranges::any_of(
        s.images, [](const StackImage& i) { return i.light.index() == 3 || i.view.index() == 3; });
    expect(s.width || !is_near, "images",
           "\"width\" beside it, in whose unit lights or views have positions");
  }
};

std::string Stack::path_of(const std::string& name) const {
  return path_beside(path, name);
}

Stack read_stack(const std::string& path) {
  Stack s;
  s.path = path;
  read_record(JsonDocument(path, Places::pointer).root(), s);
  return s;
}

std::string to_json(const Stack& s) {
  return json_text(s);
}

std::string stack_schema() {
  return schema_text<Stack>("Stack of images");
}

DirectionPair within(const DirectionPair& p, const Direction& normal) {
  const Vector n = vector_of(normal);
  const Vector t = vector_of(direction(Vector{1, 0, 0} - n.x * n));
  const Vector b = cross(n, t);
  const auto turned = [&](const Direction& d) {
    const Vector v = vector_of(d);
    return Direction{dot(v, t), dot(v, b), dot(v, n)};
  };
  return {turned(p.wi), turned(p.wo)};
}

}  // namespace gonio
