#include "coupling/coupling_config.hpp"

namespace littoral::sph {

void CouplingConfig::bind(support::Binder& b) {
  partner.bind(b, coupler::Role::sph);
  b.section("coupling", "How particles and the partner's cells meet.", [&] {
    b.choice<Removal>("removal", removal, {{"crossing", Removal::crossing}, {"nearest", Removal::nearest}})
        .doc(
            "crossing: a particle beyond the outer face goes, its mass is credited to the face element. "
            "nearest: "
            "Di Mascio et al. 2021, the particle nearest to an element that owes a particle's mass goes.");
    b.choice<FaceRows>("rows", rows, {{"level", FaceRows::level}, {"fixed", FaceRows::fixed}})
        .doc(
            "Rows of the particles that enter through an upright face which the surface crosses. level: the "
            "uppermost rise and sink with it. fixed: Di Mascio et al. 2021, they stay, and an element cut by "
            "the "
            "surface makes whole particles more rarely; for waves without a stream.");
    b.choice<SampleMethod>("samples", samples,
                           {{"corrected", SampleMethod::corrected},
                            {"shepard", SampleMethod::shepard},
                            {"quadratic", SampleMethod::quadratic}})
        .doc(
            "Values at the partner's points: corrected is exact for linear fields also near a surface, "
            "shepard for constants only; quadratic for parabolas where the kernel is whole, else as "
            "corrected.");
    b.key("phi_band", phi_band)
        .unit("particle spacings")
        .min(1.0)
        .doc("Distance from the surface within which the partner gets the level set from surface particles.");
  });
}

}  // namespace littoral::sph
