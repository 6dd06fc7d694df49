#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "companion.hpp"
#include "coupling/donors.hpp"
#include "coupling/target_cells.hpp"
#include "littoral/coupler/partner.hpp"
#include "littoral/support/scene.hpp"

namespace littoral::fv {

/// The particles, as the grid's companion: carves the region out of the blocks, offers donors, and carries
/// the state over a window as the scene's schedule has it (q: the grid's state, s: samples of t^n+1):
///
///   serial      send q^n + q' (t - t^n); receive s; step with s
///   predicted   step with extrapolated s; send q^n to that result; step back; receive s; step with s
///   iterated    serial; then again: send q^n to the last result; receive s; step back; step with s
///   concurrent  send q^n + q' (t - t^n); step with extrapolated s; step back; receive s; step with s from
///   there
template <int D>
class Coupled : public Companion<D> {
 public:
  /// forcing_constant: K of (21)
  Coupled(const support::Scene& scene, double forcing_constant, std::unique_ptr<coupler::SphPartner> partner);

  /// throws ConfigError: see carve, check_layers_covered
  void begin(Stepper<D>& stepper) override;
  std::optional<coupler::Agreement> agree(const coupler::Proposal& mine) override;
  StepReport advance(const coupler::Window& window, Stepper<D>& stepper) override;
  void goodbye(const std::string& reason) override { partner_->goodbye(reason); }
  double waited() const override { return partner_->waited(); }
  double coupling_seconds() const override { return coupling_seconds_; }
  std::string description() const override { return partner_->description(); }

  void save(StateWriter<D>& file) const override;
  void load(const support::CheckpointReader& file) override;

  /// Of the last window, summed over both programs.
  const coupler::Ledger& ledger() const { return ledger_; }

 private:
  using Values = std::vector<Imposed<D>>;
  /// whole: to the tolerance from the usual start; rough: a try on extrapolated data, which deserves half the
  /// decades; correction: from such a try, with the true data, the decades that it lacks.
  enum class Solve { whole, rough, correction };
  StepReport advance_and_exchange(const coupler::Window& window, Stepper<D>& stepper);
  void step(const coupler::Window& window, const Values& values, Stepper<D>& stepper, StepReport& total,
            Solve solve = Solve::whole);
  Values receive(const coupler::Window& window, const Stepper<D>& stepper);
  void send(const coupler::Window& window);
  /// Mass flux from the computed cells into the region [kg/s]. comm collective
  double flux_into_region(const Stepper<D>& stepper) const;
  void warn_of_long_windows(double dt);
  void warn_of_many_substeps(const coupler::Window& window);

  support::Scene scene_;
  double forcing_constant_;
  std::unique_ptr<coupler::SphPartner> partner_;
  bool forced_;
  std::optional<DonorOffer<D>> offer_;
  std::optional<TargetCells<D>> cells_;
  FringeFaces<D> interface_;
  coupler::DonorValues donors_, result_;
  coupler::Samples samples_;
  coupler::Ledger ledger_;
  std::int64_t epoch_ = 0;
  double mass_flux_ = 0.0;     // [kg] into the region, since the start
  double column_depth_ = 0.0;  // [m]
  double coupling_seconds_ = 0.0, stepping_seconds_ = 0.0;
  bool warned_ = false, warned_of_substeps_ = false;
};

}  // namespace littoral::fv
