#include "fitting/export/materialx_plan.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "brdf/catalogue/registry.h"
#include "fitting/export/materialx_parts.h"
#include "fitting/export/placement.h"
#include "fitting/export/surface.h"
#include "fitting/export/xml.h"

#include <fmt/format.h>

namespace gonio {
namespace {

std::string node_input(std::string_view name, std::string_view type, std::string_view node) {
  return fmt::format("<input name=\"{}\" type=\"{}\" nodename=\"{}\"/>\n", name, type, node);
}
std::string weight_input(std::string_view name, std::string_view weight) {
  return fmt::format("<input name=\"{}\" type=\"float\" interfacename=\"{}\"/>\n", name, weight);
}

/// Short id of the first lobe's Fresnel term; "" where a function of a file is the whole model.
std::string_view fresnel_of(const BoundModel& m) {
  return m.model.lobes.empty() ? "" : short_id(catalogue()[m.model.lobes[0].fresnel.term].id());
}
/// Of one of the diffuse terms, "" where there is none.
std::string_view diffuse_of(const BoundModel& m) {
  return m.model.diffuse.empty() ? "" : short_id(catalogue()[m.model.diffuse[0].term].id());
}
bool is_coupled(const BoundModel& m) {
  return !m.model.diffuse.empty() && catalogue()[m.model.diffuse[0].term].coupled;
}

/// Graph of a material's node, as it is built from below.
class Graph {
 public:
  explicit Graph(const PlannedModel& m)
      : exact_(surface_of(m.exact.base)), planned_(surface_of(m.planned.base)), model_(m) {
    std::string below = diffuse();
    if (!exact_.lobes.empty()) below = under_lobe(below);
    if (m.exact.coat) below = coated(below);
    node("surface", "shader", "surfaceshader",
         below.empty() ? "" : node_input("bsdf", "BSDF", below));
  }

  /// Names of the weights that tell the planned material from the exact one.
  const std::vector<std::string>& weights() const { return weights_; }
  const std::string& nodes() const { return nodes_; }

 private:
  std::string node(std::string_view kind,
                   const std::string& name,
                   std::string_view type,
                   const std::string& inputs) {
    nodes_ += fmt::format("<{0} name=\"{1}\" type=\"{2}\">\n{3}</{0}>\n", kind, name, type, inputs);
    return name;
  }
  /// What is `on` where the weight is 1, and `off` where it is 0.
  std::string switched(const std::string& weight,
                       std::string_view type,
                       const std::string& on,
                       const std::string& off) {
    weights_.push_back(weight);
    return node(
        "mix", weight + "_or_not", type,
        node_input("fg", type, on) + node_input("bg", type, off) + weight_input("mix", weight));
  }

  std::string diffuse_node(std::string_view id, const Surface& s, const std::string& name) {
    const bool burley = id.starts_with("disney");
    const double roughness = burley && !s.lobes.empty() ? one_roughness(s.lobes[0]) : 0;
    return node(burley ? "burley_diffuse_bsdf" : "oren_nayar_diffuse_bsdf", name, "BSDF",
                input("color", "color3", s.kd) + input("roughness", "float", {roughness}));
  }
  /// Of the diffuse term, which may be left out or be a simpler one; "" where there is none.
  std::string diffuse() {
    if (exact_.largest_kd() <= 0) return "";
    const auto id = diffuse_of(model_.exact.base), other = diffuse_of(model_.planned.base);
    std::string full = diffuse_node(id, exact_, "diffuse_all");
    if (planned_.largest_kd() <= 0) {
      weights_.emplace_back("diffuse");
      return node("multiply", "diffuse_or_not", "BSDF",
                  node_input("in1", "BSDF", full) + weight_input("in2", "diffuse"));
    }
    const auto shape = [](std::string_view of) { return of.substr(0, of.find('.')); };
    if (shape(id) == shape(other)) return full;
    return switched("diffuse_shape", "BSDF", full, diffuse_node(other, planned_, "diffuse_simple"));
  }

  std::string roughness(const SurfaceLobe& l, const std::string& name) {
    const auto [wide, narrow, tangent] = stretch_of(l, 0);
    return node("constant", name, "vector2", input("value", "vector2", {wide, narrow}));
  }
  /// Widths of the first lobe, which may be made one; the tangent along the wider.
  std::string lobe_shape() {
    const auto &l = exact_.lobes[0], &p = planned_.lobes[0];
    std::string rough = roughness(l, "roughness_all");
    if (l.alpha_x != l.alpha_y && p.alpha_x == p.alpha_y)
      rough = switched("anisotropy", "vector2", rough, roughness(p, "roughness_even"));
    std::string inputs = node_input("roughness", "vector2", rough);
    const double turn = stretch_of(l, model_.tangent_deg).tangent_deg;
    if (l.alpha_x != l.alpha_y && turn != 0) {
      node("normal", "normal", "vector3",
           "<input name=\"space\" type=\"string\" value=\"world\"/>\n");
      node("tangent", "tangent", "vector3",
           "<input name=\"space\" type=\"string\" value=\"world\"/>\n");
      node("rotate3d", "turned_tangent", "vector3",  // clockwise, seen from above
           node_input("in", "vector3", "tangent") + input("amount", "float", {-turn}) +
               node_input("axis", "vector3", "normal"));
      inputs += node_input("tangent", "vector3", "turned_tangent");
    }
    return inputs;
  }
  std::string lobe_node(std::string_view fresnel,
                        const SurfaceLobe& l,
                        const std::string& shape,
                        const std::string& name) {
    const std::string all = input("weight", "float", {l.weight}) + shape;
    if (fresnel.starts_with("conductor"))
      return node("conductor_bsdf", name, "BSDF",
                  all + input("ior", "color3", l.eta) + input("extinction", "color3", l.k));
    if (fresnel.starts_with("dielectric")) {
      const auto like = grey_dielectric(l);
      return node("dielectric_bsdf", name, "BSDF",
                  all + input("ior", "float", {like.eta}) + input("tint", "color3", like.tint));
    }
    const bool schlick = fresnel.starts_with("schlick");
    return node("generalized_schlick_bsdf", name, "BSDF",
                all + input("color0", "color3", l.f0) +
                    input("color82", "color3", schlick ? std::vector{1.0} : l.f82_tint));
  }
  std::string under_lobe(const std::string& below) {
    const auto shape = lobe_shape();
    const auto id = fresnel_of(model_.exact.base), other = fresnel_of(model_.planned.base);
    std::string lobe = lobe_node(id, exact_.lobes[0], shape, "highlight_all");
    if (id != other)
      lobe = switched("fresnel", "BSDF", lobe,
                      lobe_node(other, planned_.lobes[0], shape, "highlight_simple"));
    if (below.empty()) return lobe;
    const bool coupled = is_coupled(model_.exact.base);
    const bool stays = coupled == is_coupled(model_.planned.base) || planned_.largest_kd() <= 0;
    const auto layered = [&] {
      return node("layer", "layered", "BSDF",
                  node_input("top", "BSDF", lobe) + node_input("base", "BSDF", below));
    };
    const auto added = [&] {
      return node("add", "added", "BSDF",
                  node_input("in1", "BSDF", lobe) + node_input("in2", "BSDF", below));
    };
    if (stays) return coupled ? layered() : added();
    const auto on = layered(), off = added();
    return switched("coupling", "BSDF", on, off);
  }
  std::string coated(const std::string& below) {
    const auto lobe = surface_of(*model_.exact.coat).lobes[0];
    if (lobe.weight <= 0) return below;  // a shader for every material has one all the same
    std::string inputs = node_input("roughness", "vector2", roughness(lobe, "coat_roughness")) +
                         input("ior", "float", {grey_dielectric(lobe).eta});
    if (model_.planned.coat) {
      inputs += input("weight", "float", {lobe.weight});
    } else {
      weights_.emplace_back("coat");
      inputs += lobe.weight == 1
                    ? weight_input("weight", "coat")
                    : node_input(
                          "weight", "float",
                          node("multiply", "coat_or_not", "float",
                               input("in1", "float", {lobe.weight}) + weight_input("in2", "coat")));
    }
    node("dielectric_bsdf", "coat_lobe", "BSDF", inputs);
    if (below.empty()) return "coat_lobe";
    return node("layer", "coated", "BSDF",
                node_input("top", "BSDF", "coat_lobe") + node_input("base", "BSDF", below));
  }

  Surface exact_, planned_;
  const PlannedModel& model_;
  std::vector<std::string> weights_;
  std::string nodes_;
};

/// Name that MaterialX takes, and that none of the others has.
std::string valid_name(const std::string& name, std::set<std::string>& taken) {
  std::string valid = name;
  for (char& c : valid)
    if (!(('a' <= c && c <= 'z') || ('A' <= c && c <= 'Z') || ('0' <= c && c <= '9'))) c = '_';
  if (valid.empty() || ('0' <= valid[0] && valid[0] <= '9')) valid = "_" + valid;
  std::string own = valid;
  for (int k = 2; taken.contains(own) || taken.contains(own + "_exact"); ++k)
    own = valid + "_" + std::to_string(k);
  taken.insert({own, own + "_exact"});
  return own;
}

std::string material(const std::string& kind,
                     const std::string& name,
                     const std::vector<std::string>& weights,
                     double weight) {
  std::string inputs;
  for (const auto& w : weights) inputs += input(w, "float", {weight});
  return fmt::format(
      "<{0} name=\"{1}_shader\" type=\"surfaceshader\">\n{2}</{0}>\n<surfacematerial "
      "name=\"{1}\" type=\"material\">\n<input name=\"surfaceshader\" type=\"surfaceshader\" "
      "nodename=\"{1}_shader\"/>\n</surfacematerial>\n",
      kind, name, inputs);
}

/// Sentences on what of both surfaces MaterialX has otherwise; each once over all materials.
void differences(const PlannedModel& m, std::vector<std::string>& to) {
  const auto add = [&](std::string_view said) {
    if (std::ranges::find(to, said) == to.end()) to.emplace_back(said);
  };
  for (const auto& said : lost_by_all(m.planned.base, "MaterialX's", "correlated"))
    if (!said.starts_with("The shape of the diffuse")) add(said);
  if (!m.planned.base.model.lobes.empty())
    add("Light between facets: MaterialX always gives it back, whether or not the plan does.");
  if (m.planned.base.model.lobes.size() > 1) add("Further lobes: only the first is written.");
  if (is_coupled(m.planned.base))
    add("Coupling: MaterialX takes the highlight's albedo from what lies below, not its Fresnel.");
  const auto shape = diffuse_of(m.planned.base);
  if (!shape.empty() && !shape.starts_with("lambert") && !shape.starts_with("disney"))
    add("The diffuse term is written as Lambert's.");
}

}  // namespace

MaterialxPlan materialx_of(std::span<const PlannedModel> materials, const std::string& plan) {
  MaterialxPlan out;
  std::string elements = "<materialx version=\"1.39\" colorspace=\"lin_rec709\">\n";
  std::set<std::string> taken;
  for (const auto& m : materials) {
    const std::string name = valid_name(m.name, taken), kind = "gonio_" + name;
    const Graph graph(m);
    std::string inputs;
    for (const auto& w : graph.weights()) inputs += input(w, "float", {1});
    elements += fmt::format(
        "<nodedef name=\"ND_{0}\" node=\"{0}\" nodegroup=\"pbr\">\n{1}<output name=\"out\" "
        "type=\"surfaceshader\"/>\n</nodedef>\n<nodegraph name=\"NG_{0}\" nodedef=\"ND_{0}\">\n{2}"
        "<output name=\"out\" type=\"surfaceshader\" nodename=\"shader\"/>\n</nodegraph>\n",
        kind, inputs, graph.nodes());
    elements += material(kind, name, graph.weights(), 0);
    elements += material(kind, name + "_exact", graph.weights(), 1);
    differences(m, out.differs);
  }
  out.file = xml_file(elements + "</materialx>\n", "the plan as it was made", plan);
  return out;
}

}  // namespace gonio
