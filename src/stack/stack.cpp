#include "stack/stack.h"

#include <filesystem>

#include "base/file.h"
#include "base/json/form.h"

namespace gonio {

template <Side side>
constexpr std::string_view name_of_side = side == Side::light ? "light" : "view";
/// "i" of incident, "o" of outgoing
template <Side side>
constexpr std::string_view letter = side == Side::light ? "i" : "o";

template <class Form, Side side>
void keys(Form& f, SideAngles<side>& a) {
  const std::string of(letter<side>);
  f.required("theta_" + of, a.theta_deg, "angle of all texels from the normal [°]",
             Numbers{0, 90, false, true});
  f.optional("phi_" + of, a.phi_deg, "azimuth from x towards y [°]", Numbers{-360, 360});
}
template <class Form, Side side>
void keys(Form& f, SideVector<side>& v) {
  constexpr double far = 1e9;
  const std::string key(name_of_side<side>);
  f.required(key, v.towards, "vector of all texels, of any length but 0, z above 0",
             Numbers{-far, far});
  f.expect(v.towards.z > 0, key, "a direction above the surface: z above 0");
}
template <class Form, Side side>
void keys(Form& f, SideMap<side>& m) {
  f.required(std::string(name_of_side<side>) + "_map", m.path,
             "path of an image with a vector for each texel");
}
template <class Form>
void keys(Form& f, StackImage& i) {
  f.required("path", i.path, "of an OpenEXR file or an array of NumPy's, linear");
  f.by_key(i.light, {"theta_i", "light", "light_map"});
  f.by_key(i.view, {"theta_o", "view", "view_map"});
  f.optional("scale", i.scale, "what its numbers are multiplied with", Numbers{0, 1e30, true});
}
template <class Form>
void keys(Form& f, StackTruth& t) {
  f.required("model", t.model, "that was evaluated");
  f.required("parameters", t.parameters, "path of an image with a channel for each parameter");
  f.optional("noise", t.noise, "values were multiplied by exp(noise · z), z standard normal",
             Numbers{0, 5});
  f.optional("seed", t.seed, "of the noise");
}
template <class Form>
void keys(Form& f, Stack& s) {
  f.constant("schema", "gonio.stack/1");
  f.optional("values", s.values, "what the images hold [1/sr]");
  f.optional("channels", s.channels,
             "of each image, one or three; else R, G and B, or the only one it has", Entries{1, 3});
  f.expect(!s.channels || s.channels->size() != 2, "channels", "an array of 1 or 3");
  f.optional("normals", s.normals,
             "path of an image with the normal of each texel, linear in [-1, 1]");
  f.required("images", s.images, "one for each pair of light and view", Entries{1, 10'000});
  f.optional("truth", s.truth, "what gonio made the stack from");
}

std::string Stack::path_of(const std::string& name) const {
  return (std::filesystem::path(path).parent_path() / name).string();
}

Stack read_stack(const std::string& path) {
  Stack s;
  s.path = path;
  read_form(JsonDocument(path, InputFile(path).read_rest(most_document_bytes), Places::pointer).root(), s);
  return s;
}

std::string to_json(const Stack& s) {
  return text_of(form_json(s));
}

std::string stack_schema() {
  return form_schema<Stack>("Stack of images");
}

}  // namespace gonio
