#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "config.hpp"
#include "dual_time/stepper.hpp"
#include "io/gauges.hpp"
#include "littoral/coupler/window.hpp"
#include "littoral/support/log.hpp"
#include "littoral/support/scene.hpp"
#include "littoral/support/series.hpp"
#include "littoral/support/timers.hpp"
#include "physics/measures.hpp"

namespace littoral::fv {

/// Everything a run leaves in OUT/fv: scalars.csv, gauges.csv, fields, checkpoints. The root writes.
/// comm collective
template <int D>
class Output {
 public:
  /// `folder` is OUT/fv, made here. restarted: go on in the files of the run before, later rows cut off.
  Output(const std::string& folder, const FvConfig& config, const support::Scene& scene,
         const Stepper<D>& stepper, const support::Timers& timers, bool restarted);

  /// Row, gauges and fields of the start.
  void first(const Stepper<D>& stepper, double waited);
  /// After a window: rows that are due, fields where the agreement says so.
  void after(const coupler::Agreement& agreement, const Stepper<D>& stepper, const StepReport& report,
             double waited);
  void last(const Stepper<D>& stepper);

  /// True if fields are due in a window that ends at `time`.
  bool fields_due(double time) const;
  double last_fields() const { return fields_written_at_; }  ///< time of the last fields [s]
  /// Of the run that this one continues.
  void set_last_fields(double time) { fields_written_at_ = time; }

  const Integrals& integrals() const { return integrals_; }
  const std::string& folder() const { return folder_; }

 private:
  void row(const Stepper<D>& stepper, const StepReport& report, double waited);
  void fields(const Stepper<D>& stepper);

  std::string folder_;
  Ranks ranks_;
  support::Scene scene_;
  FvConfig::Output options_;
  const support::Timers& timers_;
  Gauges<D> gauges_;
  std::vector<std::string> walls_;
  std::vector<coupler::Box> regions_;
  std::optional<support::CsvSeries> scalars_, gauge_rows_;
  std::optional<support::FieldSeries> fields_;
  Integrals integrals_;
  double fields_written_at_ = -1.0;  // [s]
};

/// Share of all blocks' integrals outside the regions. comm collective
template <int D>
Integrals integrate_all(const Stepper<D>& stepper, const std::vector<coupler::Box>& regions);

}  // namespace littoral::fv
