// The file that says what a camera sees.

#include "stdlib/impl/vision/camera_file.h"

#include <catch2/catch.hpp>

#include <string>

using rt::lib::CameraFile;
using rt::lib::readCameraFile;

namespace {

std::string problemOf(const std::string& text) {
    CameraFile file;
    return readCameraFile(text, file);
}

} // namespace

TEST_CASE("A camera file may leave everything out", "[stdlib][vision]") {
    CameraFile file;
    CHECK(readCameraFile("{}", file).empty());
    CHECK_FALSE(file.runMode);
    CHECK(file.job.empty());
    CHECK(file.jobs.empty());
    CHECK(file.loadSeconds == 1);
    CHECK(file.imageSeconds == 0.2);
}

TEST_CASE("Parts of an image have a position, a rotation about z or an orientation, values and texts",
          "[stdlib][vision]") {
    CameraFile file;
    REQUIRE(readCameraFile(R"({"jobs": {"A.job": {"images": [{"parts": [
        {"name": "p", "position": [1, 2, 3], "rotation": 180, "values": [4, 5], "strings": ["s"], "type": 6},
        {"orient": [0, 0, 2, 0]}]}]}}})",
                           file)
                .empty());
    const auto& job = file.jobs.at("a.job");
    CHECK(job.name == "A.job");
    CHECK(job.repeats);
    const auto& parts = job.images.at(0).parts;
    CHECK(parts[0].frame.pos.z == 3);
    CHECK(parts[0].frame.rot.w == Approx(0).margin(1e-12));
    CHECK(parts[0].frame.rot.z == Approx(1));
    CHECK(parts[0].values[1] == 5);
    CHECK(parts[0].values[2] == 0);
    CHECK(parts[0].texts[0] == "s");
    CHECK(parts[0].type == 6);
    CHECK(parts[1].frame.rot.y == 1);
}

TEST_CASE("What is wrong with a camera file is said with its place", "[stdlib][vision]") {
    CHECK(problemOf("[]") == "the file is not an object");
    CHECK(problemOf(R"({"mode": "auto"})") == "mode is neither \"run\" nor \"program\"");
    CHECK(problemOf(R"({"load_seconds": -1})") == "the file.load_seconds is a negative time");
    CHECK(problemOf(R"({"jobs": {"a": {"repeat": 1}}})") == "jobs.a.repeat is neither true nor false");
    CHECK(problemOf(R"({"job": "b", "jobs": {"a": {}}})") == "job is not one of the jobs");
    CHECK(problemOf(R"({"parameters": {"x": null}})") == "parameters.x is not a text");
    CHECK(problemOf(R"({"silent": [[2, 1]]})") == "silent has a span that ends before it begins");
    CHECK(problemOf(R"({"jobs": {"a": {"images": [{"parts": [{"position": [1, 2]}]}]}}})") ==
          "jobs.a.images[0].parts[0].position is not a list of 3 members");
    CHECK(
        problemOf(R"({"jobs": {"a": {"images": [{"parts": [{"rotation": 1, "orient": [1, 0, 0, 0]}]}]}}})") ==
        "jobs.a.images[0].parts[0] has both \"rotation\" and \"orient\"");
    CHECK(problemOf(R"({"jobs": {"a": {"images": [{"parts": [{"orient": [0, 0, 0, 0]}]}]}}})") ==
          "jobs.a.images[0].parts[0].orient has the length 0");
    CHECK(problemOf(R"({"jobs": {"a": {"images": [{"parts": [{"name": ")" + std::string(81, 'x') +
                    R"("}]}]}}})") ==
          "jobs.a.images[0].parts[0].name is longer than the 80 bytes of a string");
    CHECK(problemOf("{").starts_with("it is not JSON: "));
}
