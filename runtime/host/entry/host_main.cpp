// main() of an executable made by `rapidc build`: the compiled program is linked in under a fixed name.

#include "runtime/host/controller.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include <string>

extern "C" const rt::ProgramDesc rapidc_program;

int main(int argc, char** argv) {
    rt::RunOptions options;
    CLI::App app(std::string("RAPID program ") + rapidc_program.name + " on a virtual controller");
    rt::addRunOptions(app, options, false);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? 0 : static_cast<int>(rt::ExitStatus::BadUsage);
    }
    return rt::runProgram(rapidc_program, options, rt::setUpStandardLibrary);
}
