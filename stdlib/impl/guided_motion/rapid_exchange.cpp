#include "stdlib/impl/guided_motion/rapid_exchange.h"

#include "stdlib/impl/support/data_names.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <span>

namespace rt::lib {
namespace {

/// The elements of the array; none when it is not there any more.
std::span<double> numbersOf(const Task& task, const std::string& name) {
    if (name.empty()) return {};
    const AnyRef found = dataByName(task, name);
    if (found.data == nullptr || found.type->kind != DescKind::Array ||
        found.type->fields[0]->kind != DescKind::Dnum)
        return {};
    return {static_cast<double*>(found.data), std::min<std::size_t>(found.type->count, kMostRapidNumbers)};
}

} // namespace

void RapidExchange::send(const Task& task, RobotData& data) const {
    if (output >= 0) data.digital = task.controller().io().value(output) != 0;
    const std::span<double> numbers = numbersOf(task, sent);
    data.numbers.assign(numbers.begin(), numbers.end());
}

void RapidExchange::receive(const Task& task, const SensorData& data) const {
    if (input >= 0 && data.digital) (void)task.controller().io().force(input, *data.digital ? 1 : 0);
    if (data.numbers.empty()) return;
    const std::span<double> numbers = numbersOf(task, received);
    std::copy_n(data.numbers.begin(), std::min(numbers.size(), data.numbers.size()), numbers.begin());
}

} // namespace rt::lib
