// main() of an executable made by `rapidc build`: the compiled program is linked in under a fixed name.

#include "runtime/host/controller.h"
#include "runtime/host/standard_streams.h"
#include "runtime/host/usage.h"
#include "stdlib/standard_library.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include <string>

int main(int argc, char** argv) { // NOLINT(bugprone-exception-escape): out of memory may end it
    rt::guardLimits(rapidc_program.name);
    rt::guardStandardStreams();
    rt::RunOptions options;
    CLI::App app(std::string("RAPID program ") + rapidc_program.name + " on a virtual controller");
    rt::addRunOptions(app, options, false);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return rt::reportUsage(app, error, rapidc_program.name);
    }
    const int status = rt::runProgram(rapidc_program, options, rt::setUpStandardLibrary);
    return rt::finishStandardOutput(rapidc_program.name, status);
}
