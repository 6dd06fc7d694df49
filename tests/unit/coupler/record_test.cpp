#include "record_test.hpp"

#include <unistd.h>

#include <sys/wait.h>
#include <csignal>

namespace littoral::coupler {
namespace {

TEST_F(RecordTest, GridIsReplayedToTheBit) {
  const std::string recorded = run(*recording(std::make_unique<ChangingFv>(), path()));
  EXPECT_EQ(run(*std::make_unique<ChangingFv>()), recorded) << "recording changes what is said";
  EXPECT_TRUE(run(*replayed_fv_partner(path())) == recorded);
}

TEST_F(RecordTest, ParticlesAreReplayedToTheBit) {
  const std::string recorded = run(*recording(std::make_unique<ChangingSph>(), path()));
  EXPECT_TRUE(run(*replayed_sph_partner(path())) == recorded);
}

TEST_F(RecordTest, DescriptionSaysWhereItComesFrom) {
  run(*recording(std::make_unique<ChangingFv>(), path()));
  EXPECT_EQ(replayed_fv_partner(path())->description(), "replayed from " + path() + " (a grid that changes)");
}

// A killed program runs no destructor: what counts is what was flushed.
TEST_F(RecordTest, KilledRunLeavesItsWholeWindows) {
  const pid_t child = fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    auto partner = recording(std::make_unique<ChangingFv>(), path());
    run(*partner, 3);
    partner->agree(stable(0.03));
    raise(SIGKILL);
  }
  int status = 0;
  waitpid(child, &status, 0);
  ASSERT_TRUE(WIFSIGNALED(status));
  ChangingFv fresh;
  auto replayed = replayed_fv_partner(path());
  EXPECT_TRUE(run(*replayed, 3) == run(fresh, 3));
  expect_refused("the record is exhausted and 'agree' is asked", [&] { replayed->agree(stable(0.03)); });
}

TEST_F(RecordTest, RunMayStopEarlierThanItsRecord) {
  auto replayed = replayed_fv_partner(recorded());
  run(*replayed, 2);
  Proposal enough = stable(0.03);
  enough.stop = true;
  enough.reason = "seen enough";
  const Agreement agreement = replayed->agree(enough);
  EXPECT_TRUE(agreement.stop);
  EXPECT_EQ(agreement.reason, "seen enough");
  expect_refused("after a stop that this run itself wished", [&] { replayed->agree(stable(0.03)); });
  EXPECT_NO_THROW(replayed->goodbye("seen enough"));
  expect_refused("after the goodbye", [&] { replayed->goodbye("again"); });
}

TEST_F(RecordTest, RunMayWriteMoreOftenThanItsRecord) {
  auto replayed = replayed_fv_partner(recorded());
  replayed->announce(k_needs, k_covers);
  Proposal proposal = stable(0.03);
  proposal.write = true;
  EXPECT_TRUE(replayed->agree(proposal).write);
}

}  // namespace
}  // namespace littoral::coupler
