// main() of an executable made by `rapidc build`: the compiled program is linked in under a fixed name.

#include "runtime/host/command_line.h"
#include "runtime/host/controller.h"
#include "runtime/host/standard_streams.h"
#include "stdlib/standard_library.h"

#include <string>

int main(int argc, char** argv) { // NOLINT(bugprone-exception-escape): out of memory may end it
    rt::guardLimits(rapidc_program.name);
    rt::guardStandardStreams();
    rt::RunOptions options;
    rt::CommandLine commandLine(rapidc_program.name, std::string("RAPID program ") + rapidc_program.name +
                                                         " on a virtual controller");
    rt::addRunOptions(commandLine.executable(), options, false);
    const int status = commandLine.run(
        argc, argv, [&] { return rt::runProgram(rapidc_program, options, rt::setUpStandardLibrary); });
    return rt::finishStandardOutput(rapidc_program.name, status);
}
