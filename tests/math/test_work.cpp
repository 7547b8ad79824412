// Work that is stopped, timed out and followed.
#include "nacre/math/work.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace nacre {
namespace {

using Clock = Work::Clock;

TEST(Work, StopsByTheFlagOrTheClock) {
    EXPECT_NO_THROW(Work().check());
    std::atomic<bool> stop{false};
    const Work flagged(&stop, Clock::time_point::max(), {});
    EXPECT_NO_THROW(flagged.check());
    stop = true;
    EXPECT_TRUE(flagged.stopped());
    EXPECT_THROW(flagged.check(), Stopped);
    EXPECT_THROW(Work(nullptr, Clock::now(), {}).check(), Stopped);
    EXPECT_NO_THROW(Work(nullptr, Clock::now() + std::chrono::hours(1), {}).check());
}

TEST(Work, PhasesTellTheirBeginningAndNotEveryPart) {
    std::vector<std::pair<std::string, double>> told;
    const Work work(nullptr, Clock::time_point::max(),
                    [&](std::string_view phase, double share) { told.emplace_back(phase, share); });
    WorkPhase first(work, "first", 1000);
    for (int i = 0; i < 1000; ++i) first.advance();
    WorkPhase second(work, "second", 4);
    ASSERT_LT(told.size(), 20u);
    EXPECT_EQ(told.front(), std::pair(std::string("first"), 0.));
    EXPECT_EQ(told.back(), std::pair(std::string("second"), 0.));
}

TEST(Work, AStoppedPhaseEndsWithItsNextPart) {
    std::atomic<bool> stop{false};
    const Work work(&stop, Clock::time_point::max(), {});
    WorkPhase phase(work, "any", 10);
    EXPECT_NO_THROW(phase.advance());
    stop = true;
    EXPECT_THROW(phase.advance(), Stopped);
    EXPECT_THROW(WorkPhase(work, "next", 1), Stopped);
}

}  // namespace
}  // namespace nacre
