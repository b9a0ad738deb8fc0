#include "cli/fit/fit_options.h"

namespace gonio::cli {

void add_tables(Command& c, std::vector<std::string>& files) {
  c.option("FILE", files,
           "A table, its format found from the bytes; or many: several files, a "
           "folder, or @LIST with a path on each line")
      .required();
}

std::vector<Option> add_model_words(Command& c,
                                    std::string& model,
                                    std::vector<std::string>& fix,
                                    std::vector<std::string>& bounds,
                                    std::vector<std::string>& grey) {
  constexpr int most = 64;
  return {c.option("--model", model, "Model; all its parameters are fitted").show_default(),
          c.option("--fix", fix, "Parameters held at a value: NAME=VALUE …").at_most(most),
          c.option("--bounds", bounds, "Where a parameter is looked for: NAME=LOW,HIGH …")
              .at_most(most),
          c.option("--grey", grey, "Colour parameters with one value for all channels: NAME …")
              .at_most(most)};
}

Option add_metric(Command& c, std::string& metric) {
  return c.option("--metric", metric, "log, l2_cosine or relative")
      .one_of(names_of<Metric>)
      .show_default();
}

std::vector<Option> add_fit_words(Command& c, FitWords& w) {
  auto all = add_model_words(c, w.fit.model, w.fix, w.bounds, w.fit.grey);
  for (
      const auto& option :
      {add_metric(c, w.metric),
       c.option("--robust", w.robust, "none, or huber against outliers")
           .one_of({"none", "huber"})
           .show_default(),
       c.option(
            "--intervals", w.intervals,
            "Whether the values of one incident angle share their errors: independent, by_angle, "
            "or "
            "automatic (by_angle for measured tables); or bootstrap, from 400 fits of tables drawn "
            "from this one, which takes as long")
           .one_of(names_of<Intervals>)
           .show_default(),
       c.option("--copies", w.copies,
                "Angles of the table that only repeat another, value for value: leave_out, or keep")
           .one_of({"leave_out", "keep"})
           .show_default(),
       c.option("--certificate", w.certificate,
                "auto: after the fit its cost is looked at over the widths, for anything lower; or "
                "none, which is faster")
           .one_of(names_of<Certify>)
           .show_default(),
       add_bins(c, w.bins)})
    all.push_back(option);
  return all;
}

Option add_pages(Command& c, bool& pages) {
  return c.flag("--pages", pages,
                "Of many tables a page each, NAME.fit.html, to which summary.html links");
}

HowFitted how_fitted(const FitWords& w) {
  FitOptions options = w.fit;
  options.metric = value_of<Metric>(w.metric, "metric");
  options.intervals = value_of<Intervals>(w.intervals, "intervals");
  options.certificate = value_of<Certify>(w.certificate, "certificate");
  options.robust = w.robust == "huber";
  options.copies = w.copies == "keep";
  options.fixed = parse_settings(w.fix);
  options.bounds = parse_settings(w.bounds);
  return {options, bins_from(w.bins)};
}

}  // namespace gonio::cli
