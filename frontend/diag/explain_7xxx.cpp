// What the diagnostics of lowering, linking and of rapidc itself (9xxx) mean.

#include "frontend/diag/explain.h"

#include <array>

namespace rapid::diag {

namespace {

using Kind = ExampleKind;

// clang-format off
constexpr auto kExplanations = std::to_array<Explanation>({
    {7004, Kind::Files,
     "The instruction or function is predefined and its arguments are checked, but this version of rapidc cannot execute "
     "it: a program that reaches it stops with an event. `rapidc builtins` lists what can be executed.",
     R"ex($ rapidc check main.mod
main.mod:
  MODULE MainModule
    PERS sensor camera := [0, 0, 0];
    PROC main()
      SiConnect camera;
    ENDPROC
  ENDMODULE)ex",
     R"ex($ rapidc check main.mod
main.mod:
  MODULE MainModule
    PROC main()
      TPWrite "ready";
    ENDPROC
  ENDMODULE)ex"},
    {9001, Kind::Body,
     "rapidc made a mistake while it translated a correct program. Please report it with the program; a change of the "
     "instruction it names may get around it.",
     "",
     "TPWrite \"ready\";"},
});
// clang-format on

} // namespace

std::span<const Explanation> explanations7xxx() {
    return kExplanations;
}

} // namespace rapid::diag
