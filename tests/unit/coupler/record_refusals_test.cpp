// What a record does not answer.
#include <hdf5.h>

#include <fstream>

#include "record_test.hpp"

namespace littoral::coupler {
namespace {

TEST_F(RecordTest, RefusesCallsOutOfOrder) {
  auto replayed = replayed_fv_partner(recorded());
  expect_refused(", call 1 of 27: 'agree' is asked where the recorded run asked 'announce'",
                 [&] { replayed->agree(stable(0.03)); });
  replayed->announce(k_needs, k_covers);
  const Window window = replayed->agree(stable(0.03)).window;
  expect_refused(
      "'send' is asked where the recorded run asked 'receive' for window 0 (0 to 0.1 s, 4 substeps)",
      [&] { replayed->send(window, {}); });
  expect_refused("'goodbye' is asked where", [&] { replayed->goodbye("bye"); });
}

TEST_F(RecordTest, RefusesAnotherWindow) {
  auto replayed = replayed_fv_partner(recorded());
  replayed->announce(k_needs, k_covers);
  Window window = replayed->agree(stable(0.03)).window;
  DonorValues donors;
  window.index = 5;
  expect_refused("'receive' is asked for window 5", [&] { replayed->receive(window, donors); });
  window.index = 0;
  window.t_end += 1e-6;
  expect_refused("recorded is window 0 (0 to 0.1 s", [&] { replayed->receive(window, donors); });
  window.t_end = 0.1 * (1.0 + 1e-12);  // round-off of another compiler
  EXPECT_NO_THROW(replayed->receive(window, donors));
}

TEST_F(RecordTest, RefusesAnotherCount) {
  auto replayed = replayed_fv_partner(recorded());
  replayed->announce(k_needs, k_covers);
  const Window window = replayed->agree(stable(0.03)).window;
  DonorValues donors;
  replayed->receive(window, donors);
  Samples samples;
  samples.resize(replayed->targets().size() + 1, true);
  expect_refused("values in window 0, recorded are", [&] { replayed->send(window, samples); });
}

TEST_F(RecordTest, RefusesAnotherRegionOrAnotherGrid) {
  auto replayed = replayed_fv_partner(recorded());
  expect_refused("the region announced is nothing, recorded is (0.2, 0, 0.2) to (0.8, 0, 0.8)",
                 [&] { replayed->announce(k_needs, Box::nothing()); });
  const std::string particles = path("particles.h5");
  run(*recording(std::make_unique<ChangingSph>(), particles));
  expect_refused("1 targets are offered, recorded are 2", [&] {
    Targets targets = some_targets();
    for (auto* x : {&targets.x, &targets.y, &targets.z}) x->pop_back();
    replayed_sph_partner(particles)->offer({}, targets);
  });
  expect_refused("the region announced is",
                 [&] { replayed_sph_partner(particles)->offer({}, some_targets(0.26)); });
}

TEST_F(RecordTest, RefusesStepsThatWouldBeTooLong) {
  auto replayed = replayed_fv_partner(recorded());
  replayed->announce(k_needs, k_covers);
  expect_refused(
      "the longest step proposed for window 0 (0 to 0.1 s, 4 substeps) is 0.02 s, recorded are 0.025",
      [&] { replayed->agree(stable(0.02)); });
}

TEST_F(RecordTest, RefusesWishesTheRecordDoesNotHold) {
  for (auto wish : {&Proposal::region_changed, &Proposal::wants_particles}) {
    auto replayed = replayed_fv_partner(recorded());
    replayed->announce(k_needs, k_covers);
    Proposal proposal = stable(0.03);
    proposal.*wish = true;
    expect_refused("that the recorded run did not", [&] { replayed->agree(proposal); });
  }
}

TEST_F(RecordTest, RefusesAnotherScene) {
  run(*recording(analytic_fv_partner(uniform_stream({1, 0, 0}, 2.0), plan_of(4), 0.25, 2), path(), "deep"));
  EXPECT_NO_THROW(replayed_fv_partner(path(), "deep"));
  expect_refused("was recorded in another scene (deep, this run has shallow)",
                 [&] { replayed_fv_partner(path(), "shallow"); });
}

TEST_F(RecordTest, RefusesWhatIsNoRecord) {
  expect_refused<IoError>("No such file", [&] { replayed_fv_partner(path("absent.h5")); });
  std::ofstream(path("text.h5")) << "not HDF5 at all";
  expect_refused<IoError>("cannot open the record", [&] { replayed_fv_partner(path("text.h5")); });
  H5Fclose(H5Fcreate(path("other.h5").c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT));
  expect_refused<IoError>("is HDF5, but not a record", [&] { replayed_fv_partner(path("other.h5")); });
  recorded();
  expect_refused<IoError>("holds what the side 'fv' said, 'sph' was asked for",
                          [&] { replayed_sph_partner(path()); });
}

TEST_F(RecordTest, RefusesAFileCutOff) {
  recorded();
  std::filesystem::resize_file(path(), std::filesystem::file_size(path()) / 2);
  expect_refused<IoError>("cannot open the record", [&] { replayed_fv_partner(path()); });
}

TEST_F(RecordTest, RefusesARecordWithMissingValues) {
  recorded();
  const hid_t file = H5Fopen(path().c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
  const hid_t column = H5Dopen2(file, "donors/p", H5P_DEFAULT);
  const hsize_t few = 3;
  H5Dset_extent(column, &few);
  H5Dclose(column);
  H5Fclose(file);
  expect_refused<IoError>("the record is damaged: 'donors/p' holds 3 more values",
                          [&] { run(*replayed_fv_partner(path())); });
}

TEST_F(RecordTest, RefusesAPathItCannotWrite) {
  expect_refused<IoError>("cannot create the record",
                          [&] { recording(std::make_unique<ChangingFv>(), path("no/such/folder.h5")); });
}

}  // namespace
}  // namespace littoral::coupler
