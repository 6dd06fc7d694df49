#pragma once

#include <mpi.h>

#include <memory>
#include <string>

#include "littoral/coupler/partner.hpp"
#include "meeting.hpp"

namespace littoral::coupler {

/// The partner at the other end of an intercommunicator. comm: collective over the program
std::unique_ptr<FvPartner> mpi_fv_partner(MPI_Comm program, MPI_Comm intercomm, const std::string& partner,
                                          const RunPlan& plan, std::shared_ptr<Standing> standing);
std::unique_ptr<SphPartner> mpi_sph_partner(MPI_Comm program, MPI_Comm intercomm, const std::string& partner,
                                            const RunPlan& plan, std::shared_ptr<Standing> standing);

}  // namespace littoral::coupler
