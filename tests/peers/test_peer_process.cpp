// How the programs of peers are run: what they say, that they fail, that they are stopped.
#include "nacre/peers/process.h"

#include <thread>

#include "nacre/image/image.h"
#include "tests/peers/peer_fixture.h"

namespace nacre {

using PeerProcess = PeerTest;

TEST_F(PeerProcess, FailureShowsTheEndOfTheLog) {
    write_program("blender", "for i in 1 2 3 4 5 6 7; do echo line $i; echo; done; exit 3");
    const Scene scene = load(plane);
    const PeerRequest asked = request(scene);
    try {
        peers().find("cycles").run(asked);
        FAIL() << "no error";
    } catch (const RunError& error) {
        EXPECT_EQ(std::string(error.what()), "cycles failed with exit status 3; the end of " +
                                                 (asked.folder / "cycles.log").string() +
                                                 ":\nline 3\nline 4\nline 5\nline 6\nline 7");
    }
}

TEST_F(PeerProcess, SuccessWithoutAPictureIsAFailure) {
    write_program("blender", "echo nothing done");
    const Scene scene = load(plane);
    const PeerRequest asked = request(scene);
    write_image(Image(2, 2), asked.folder / "cycles.exr");  // of an earlier run
    EXPECT_THROW(peers().find("cycles").run(asked), RunError);
}

TEST_F(PeerProcess, StopEndsAProgramThatDoesNotListen) {
    write_program("blender", "trap '' TERM; sleep 60 & sleep 60");
    const Scene scene = load(plane);
    std::atomic<bool> stop = false;
    PeerRequest asked = request(scene);
    asked.stop = &stop;
    std::thread later([&] {
        std::this_thread::sleep_for(std::chrono::milliseconds(200));
        stop = true;
    });
    const auto start = std::chrono::steady_clock::now();
    try {
        peers().find("cycles").run(asked);
        ADD_FAILURE() << "no error";
    } catch (const RunError& error) {
        EXPECT_STREQ(error.what(), "cycles was stopped");
    }
    later.join();
    EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(10));
}

/// One that listens is asked first, and may tidy up.
TEST_F(PeerProcess, StopAsksBeforeItKills) {
    std::atomic<bool> stop = false;
    std::thread later([&] {
        std::this_thread::sleep_for(std::chrono::milliseconds(200));
        stop = true;
    });
    const ProcessResult r = run_process(
        {"/bin/sh", "-c", "trap 'echo tidied up; exit 5' TERM; while :; do sleep 0.05; done"},
        folder_ / "log", &stop);
    later.join();
    EXPECT_TRUE(r.stopped);
    EXPECT_EQ(r.status, 5);
    EXPECT_NE(last_lines(folder_ / "log", 3).find("tidied up"), std::string::npos);
}

TEST_F(PeerProcess, ProcessesAreMeasured) {
    const auto log = folder_ / "log";
    const ProcessResult r =
        run_process({"/bin/sh", "-c", "echo \"$1\"; echo nacre: key a value; exec sleep 0.3", "sh",
                     "it's $HOME"},
                    log);
    EXPECT_EQ(r.status, 0);
    EXPECT_FALSE(r.stopped);
    EXPECT_GE(r.seconds, 0.3);
    EXPECT_GT(r.peak_mb, 0.2);
    EXPECT_LT(r.peak_mb, 50);
    EXPECT_EQ(last_lines(log, 5), "it's $HOME\nnacre: key a value");
    EXPECT_EQ(log_value(log, "key"), "a value");
    EXPECT_EQ(run_process({"/bin/sh", "-c", "kill -9 $$"}, log).status, 128 + 9);
    EXPECT_THROW(run_process({"/nowhere/program"}, log), RunError);
    EXPECT_EQ(command_line({"/bin/a", "-x", "it's", ""}), "/bin/a -x 'it'\\''s' ''");
}

}  // namespace nacre
