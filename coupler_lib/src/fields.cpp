#include "littoral/coupler/fields.hpp"

namespace littoral::coupler {

void DonorValues::resize(std::size_t n, bool with_phi) {
  for (auto* field : {&p, &u, &v, &w, &dp_dt, &du_dt, &dv_dt, &dw_dt}) field->resize(n);
  phi.resize(with_phi ? n : 0);
  dphi_dt.resize(with_phi ? n : 0);
}

void Samples::resize(std::size_t n, bool with_phi) {
  for (auto* field : {&p, &u, &v, &w, &coverage}) field->resize(n);
  phi.resize(with_phi ? n : 0);
  status.resize(n, SampleStatus::uncovered);
}

}  // namespace littoral::coupler
