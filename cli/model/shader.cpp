// gonio shader: a term, a map or a model as a shader's source.
#include "shader/shader.h"

#include <algorithm>

#include "answer/file_functions.h"
#include "answer/model_argument.h"
#include "base/file.h"
#include "base/json/reader.h"
#include "brdf/catalogue/foreign_terms.h"
#include "brdf/catalogue/registry.h"
#include "brdf/model/fit_misfit.h"
#include "cli/line/command.h"
#include "cli/line/terminal.h"
#include "integrate/light/split_sum.h"
#include "integrate/light/split_sum_table.h"
#include "integrate/scattering/compensation.h"
#include "scene/plan/document.h"
#include "shader/evidence.h"

#include <fmt/format.h>

namespace gonio::cli {
namespace {

struct ShaderCall : Common {
  std::string subject, name = "brdf";
  shader::Language language{};
  shader::Precision precision = shader::Precision::float_;
  std::vector<std::string> set, grey, inputs, derivatives;
  std::optional<std::string> output, table, material;
  std::optional<shader::Compensation> compensation;
  shader::AlbedoFrom albedo = shader::AlbedoFrom::table;
  bool without_evidence = false;
};

/// Term of that id, prefix included, or of a file's function that is no whole model; a spec that is one word means the model.
std::optional<std::size_t> term_named(const std::string& subject) {
  if (is_foreign(subject)) {
    const auto term = find_term(subject);
    return catalogue()[term].role() == Role::diffuse ? std::nullopt : std::optional(term);
  }
  const auto terms = catalogue();
  const auto at = std::ranges::find(terms, subject, &TermEntry::id);
  if (at == terms.end()) return {};
  return static_cast<std::size_t>(at - terms.begin());
}

/// True of what is in the catalogue by itself, under an id with a prefix.
bool is_of_catalogue(const std::string& subject) {
  return term_named(subject) || find_map(subject);
}

/// Refuses entries of the catalogue that are no closed forms, and says what to take.
void refuse_integrals(const std::string& subject) {
  const auto refuse = [&](const About& about, const char* instead) {
    if (subject == about.id)
      throw wrong_usage(fmt::format("{} has no closed form: {}", about.id, instead));
  };
  refuse(split_sum_about, "gonio split_sum writes it as a table");
  for (const About* about : {&walk_about, &deterministic_about})
    refuse(*about, "--compensation writes what comes near it, gonio albedo says how near");
}

/// What a plan ships of a material: the model with its parameters, and the compensation that it keeps.
struct Planned {
  BoundModel model;
  std::optional<shader::Compensation> compensation;
};
Planned planned(const std::string& path, const std::string& name) {
  using scene::Effect;
  const auto material = scene::read_planned_material(path, name);
  const auto& forms = material.forms;
  for (const auto effect : {Effect::coat, Effect::spectrum, Effect::precision})
    if (forms.keeps(effect))
      throw wrong_usage(fmt::format("'{}' keeps {} '{}', which no shader is written of", name,
                                    name_of(effect), forms.name(effect)));
  std::vector<Setting> settings;
  for (const auto& [parameter, values] : material.parameters)
    settings.push_back({parameter, values});
  const auto bad = [&](const std::string& found) {
    return bad_input(path, "materials." + name, found, "a model with all its parameters");
  };
  Planned p;
  try {
    p.model = bind_model(material.spec, std::move(settings), 3);
  } catch (const Error& e) {  // the words are the file's, not the user's
    throw bad(e.what());
  }
  for (const auto& parameter : p.model.model.parameters)
    if (std::ranges::find(p.model.given, parameter.name) == p.model.given.end())
      throw bad("no " + parameter.name);
  if (forms[Effect::compensation] == scene::Form::tabulated)
    throw wrong_usage(
        fmt::format("'{}' keeps compensation 'tabulated', a table of random walks that no shader "
                    "is written of",
                    name));
  p.compensation = find_value<shader::Compensation>(forms.name(Effect::compensation));
  return p;
}

shader::TracedFormula traced(const ShaderCall& o, std::vector<std::string>& remarks) {
  refuse_integrals(o.subject);
  const auto precision = o.precision;
  if (is_of_catalogue(o.subject)) {
    if (!o.set.empty() || !o.inputs.empty() || !o.grey.empty() || o.compensation || o.material)
      throw wrong_usage(
          "--set, --grey, --inputs, --compensation and --material go with a model: of a term or a "
          "map all parameters are numbers and inputs");
    if (const auto map = find_map(o.subject))
      return shader::trace_map(*map, precision, o.derivatives);
    return shader::trace_term(*term_named(o.subject), precision, o.derivatives);
  }
  std::optional<shader::Compensating> compensating;
  if (o.compensation) compensating = {*o.compensation, o.albedo};
  if (o.albedo != shader::AlbedoFrom::table && !o.compensation && !o.material)
    throw wrong_usage("--albedo goes with --compensation");
  if (o.material) {
    if (file_in(o.subject).empty())
      throw wrong_usage(
          fmt::format("--material goes with a plan.json: '{}' is a model", o.subject));
    if (!o.set.empty() || !o.grey.empty() || o.compensation)
      throw wrong_usage("--material: its model, parameters and compensation are the plan's");
    const auto p = planned(o.subject, *o.material);
    if (p.compensation) compensating = {*p.compensation, o.albedo};
    return shader::trace_model(p.model, precision, o.inputs, o.derivatives, compensating);
  }
  if (!o.grey.empty() && !file_in(o.subject).empty())
    throw wrong_usage("--grey goes with a model: a fit says which of its colours are grey");
  if (!file_in(o.subject).empty())
    if (const auto factor =
            typical_misfit(o.subject, InputFile(o.subject).read_rest(most_document_bytes)))
      remarks.push_back(
          fmt::format("The fit is off its table by a factor of {:.3g} typically.", *factor));
  const auto model = o.grey.empty() ? model_argument(o.subject, parse_settings(o.set)).model
                                    : bind_model(o.subject, parse_settings(o.set), {}, o.grey);
  return shader::trace_model(model, precision, o.inputs, o.derivatives, compensating);
}

/// True where a GLSL file's own function is asked for as it is.
bool is_asked_as_it_is(const ShaderCall& o) {
  return o.language == shader::Language::glsl && foreign::is_name(o.subject) && o.set.empty() &&
         o.grey.empty() && o.inputs.empty() && o.derivatives.empty() && !o.compensation &&
         !o.material && o.name == "brdf" && foreign::parse_name(o.subject).file.ends_with(".glsl");
}

/// A file's function, of which evidence is asked: no formula is traced, for its text may have what no other shader is written of.
shader::TracedFormula untraced(const ShaderCall& o) {
  const auto term = find_term(o.subject);
  shader::TracedFormula f{};
  f.id = o.subject;
  f.precision = o.precision;
  shader::UsedTerm used{term, std::string(catalogue()[term].id()), {}};
  used.known.resize(catalogue()[term].parameters.size());
  f.terms.push_back(std::move(used));
  return f;
}

Operations operations_of(const std::string& own_function) {
  Operations all;
  for (const auto& f : file_functions(own_function).functions) all += f.operations;
  return all;
}

/// What E of the function's arguments is looked up in.
std::string table_remark(const shader::TracedFormula& f, const std::string& masking) {
  const bool of_both =
      std::ranges::find(f.parameters, "E_light", &shader::Argument::name) != f.parameters.end();
  return fmt::format(
      "E_view is R + G at (NoV, roughness) of the table that --table writes, as does gonio "
      "split_sum --masking {} --size 64x64 --precision half{}.",
      masking,
      of_both ? "; E_light is the same at NoL, and E_average 2 ∫ E mu dmu at that roughness" : "");
}
/// Masking of the lobe whose albedo a split-sum table has; none of another distribution than GGX.
std::optional<std::string> tabulated_masking(const shader::TracedFormula& f) {
  std::optional<std::string> masking;
  bool ggx = false;
  for (const auto& t : f.terms) {
    const auto& entry = catalogue()[t.term];
    if (entry.role() == Role::ndf && t.part == "D") ggx = entry.id() == "ndf.ggx";
    if (entry.role() == Role::masking && t.part == "V" && entry.parameters.size() == 1)
      masking = entry.id();  // the table knows no other parameter than roughness
  }
  return ggx ? masking : std::nullopt;
}

bool reads_albedo(const shader::TracedFormula& f) {
  return std::ranges::find(f.parameters, "E_view", &shader::Argument::name) != f.parameters.end();
}

Exit run(const ShaderCall& o) {
  use(o);
  shader::check_function_name(o.name);  // before seconds are spent
  const auto file = is_of_catalogue(o.subject) ? std::vector<std::string>{} : file_in(o.subject);
  std::vector<std::string> outputs;
  for (const auto& path : {o.output, o.table})
    if (path) outputs.push_back(*path);
  check_outputs(file, outputs);
  std::optional<OutputFile> out, table;
  if (o.output) out.emplace(*o.output);
  if (o.table) table.emplace(*o.table);
  Progress progress(o.quiet);
  shader::ShaderDocument d;
  std::vector<std::string>
      of_fit;  // which come first: no shader is nearer to the table than its fit
  const bool as_it_is = is_asked_as_it_is(o);
  d.formula = as_it_is ? untraced(o) : traced(o, of_fit);
  d.writing.language = o.language;
  d.writing.name =
      as_it_is ? foreign_term(d.formula.terms[0].term)->function->name.function : o.name;
  if (!o.without_evidence)
    d.writing.remarks = shader::evidence_of(
        d.formula, d.writing.language,
        [&](std::string_view term) { progress(fmt::format("looking at what {} loses", term)); });
  d.writing.remarks.insert(d.writing.remarks.begin(), of_fit.begin(), of_fit.end());
  const auto masking = tabulated_masking(d.formula);
  const bool reads = reads_albedo(d.formula);
  if (o.table && !reads)
    throw wrong_usage("--table goes with a --compensation that looks its albedo up");
  if (reads && masking) d.writing.remarks.push_back(table_remark(d.formula, *masking));
  const auto operations = as_it_is ? operations_of(o.subject) : d.formula.operations();
  d.source =
      as_it_is ? shader::own_shader_source(
                     d.formula, d.writing, operations,
                     InputFile(foreign::parse_name(o.subject).file).read_rest(most_document_bytes))
               : shader::shader_source(d.formula, d.writing);
  if (table) {
    if (!masking)
      throw wrong_usage("--table: the first lobe is not of ndf.ggx and a masking of only alpha");
    progress("making the table");
    const auto texels = stored(split_sum_table(*masking, 64, 64), Storage::half);
    write_split_sum_table(table->temporary_path(), texels, Storage::half);
  }
  if (out) out->write(d.source);
  if (out) out->commit();
  if (table) table->commit();
  progress.clear();
  if (o.json)
    fmt::print("{}", shader::to_json(d));
  else if (!out)
    fmt::print("{}", d.source);
  else
    say("wrote {}: {} operations\n", *o.output, operations.total());
  return Exit::done;
}

}  // namespace

void add_shader(CommandLine& line) {
  auto [c, o] = line.command<ShaderCall>(
      "shader",
      "Writes a model, a term or a map as a shader's function, with what is known of its error",
      "gonio shader lambert.coupled+ggx/smith_ggx.correlated/schlick --language glsl "
      "--precision half -o brdf.glsl",
      run);
  c.option(
       "SPEC", o->subject,
       "Model, the fit.json of a fit, the plan.json of a plan, or a term or a map as `gonio "
       "models` lists it; a GLSL file's function by itself becomes its own text with that header")
      .required();
  c.option("--language", o->language, "glsl, wgsl or slang").required();
  c.option("--precision", o->precision, "Number that it computes in: float or half").show_default();
  c.option("--material", o->material, "Material of a plan, where that is what SPEC names");
  add_set(c, o->set);
  c.option("--grey", o->grey, "Parameters of colours that are one number: NAME,…").delimiter(',');
  c.option("--inputs", o->inputs,
           "Parameters that stay the function's arguments, of a fit or beside --set: NAME,…")
      .delimiter(',');
  c.option("--derivatives", o->derivatives, "Parameters by which the value is derived, too: NAME,…")
      .delimiter(',');
  c.option("--compensation", o->compensation,
           "What gives back the light that the first lobe loses between facets: turquin, "
           "fdez_aguera or kulla_conty, which read albedos as arguments");
  c.option(
       "--albedo", o->albedo,
       "Where turquin and fdez_aguera have the lobe's albedo from: table, an argument; fit, the "
       "catalogue's "
       "formula for GGX under correlated Smith")
      .show_default();
  c.option("--table", o->table, "OpenEXR file for the table of that albedo: R + G of 64x64 texels");
  c.option("--name", o->name, "Name of the function").show_default();
  c.flag("--without-evidence", o->without_evidence,
         "Leaves out of the header what is known of the error, which takes seconds");
  c.option("-o,--output", o->output, "File to write  (default: the terminal)");
  add_follow_paths(c, *o);
  add_jobs(c, *o);
  add_output(c, *o);
}

}  // namespace gonio::cli
