#include "stdlib/impl/motion/state.h"
#include "stdlib/native_table.h"

namespace rt {

void setUpStandardLibrary(Controller& controller) {
    for (const ErrorEntry& entry : errorTable())
        controller.log().addErrorName(entry.number, entry.name, entry.summary);
    controller.onProgramReset(lib::resetSettings);
}

} // namespace rt
