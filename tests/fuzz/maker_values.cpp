// Expressions, and the data in them.

#include "tests/fuzz/program_maker.h"

#include <algorithm>

namespace rapid::fuzz {

bool ProgramMaker::isWritable(const Datum& datum) {
    return datum.access != Access::Const && datum.access != Access::Loop && !datum.isSwitch;
}

std::string ProgramMaker::wholeNumber() {
    static const std::vector<std::string> kNumbers = {"1", "0", "2",  "3",    "5",    "7",       "10",
                                                      "1", "2", "60", "1000", "4096", "8388607", "16777216"};
    return choose_.of(kNumbers);
}

std::string ProgramMaker::number() {
    static const std::vector<std::string> kFractions = {"0.5",   "1.25", "0.1",  "3.14159", "1E3",
                                                        "1E-5",  "2.5",  "0x1F", "0b101",   "0o17",
                                                        "123.4", ".5",   "1E10", "99.99"};
    return choose_.chance(60) ? wholeNumber() : choose_.of(kFractions);
}

std::string ProgramMaker::literal(const TypeOf& type, bool constant) {
    switch (type.kind) {
    case Kind::Num:
        if (type.name == "byte") return std::to_string(choose_.below(256));
        return (choose_.chance(20) ? "-" : "") + number();
    case Kind::Dnum: return (choose_.chance(20) ? "-" : "") + number();
    case Kind::Bool: return choose_.chance(50) ? "TRUE" : "FALSE";
    case Kind::String: {
        static const std::vector<std::string> kTexts = {
            "\"\"",        "\"abc\"",   "\"Hello World\"", "\"a\"\"b\"",
            "\"12.5\"",    "\"\\07x\"", "\"[1,2,3]\"",     "\"TRUE\"",
            "\"HOME:/f\"", "\"äö\"",    "\"r0\"",          "\"0123456789012345678901234567890123456789\""};
        return choose_.of(kTexts);
    }
    case Kind::Record: {
        std::string text = "[";
        for (size_t i = 0; i < type.parts.size(); ++i)
            text += (i > 0 ? "," : "") + literal(*type.parts[i].second, constant);
        return text + "]";
    }
    default: return "";
    }
}

std::string ProgramMaker::aggregate(const TypeOf& type, int rank, std::array<int, 3> dims, int depth) {
    std::string text = "[";
    const int count = dims[0] > 0 ? dims[0] : 1 + static_cast<int>(choose_.below(3));
    for (int i = 0; i < count; ++i) {
        if (i > 0) text += ",";
        if (rank > 1)
            text += aggregate(type, rank - 1, {dims[1], dims[2], 0}, depth);
        else
            text += constantOnly_ ? literal(type, true) : expr(type, depth - 1);
    }
    return text + "]";
}

std::string ProgramMaker::arrayValue(const TypeOf& type, int rank, const std::array<int, 3>& dims,
                                     int depth) {
    std::vector<const Datum*> fitting;
    const auto look = [&](const Datum& datum) {
        if (datum.type != &type || datum.rank != rank || datum.optional) return;
        for (size_t k = 0; k < static_cast<size_t>(rank); ++k)
            if (dims[k] != 0 && datum.dims[k] != 0 && dims[k] != datum.dims[k]) return;
        fitting.push_back(&datum);
    };
    for (const Datum& datum : globals_)
        look(datum);
    for (const Datum& datum : locals_)
        look(datum);
    if (!fitting.empty() && choose_.chance(65)) return choose_.of(fitting)->name;
    std::array<int, 3> known = dims;
    for (int& dim : known)
        if (dim == 0) dim = 1 + static_cast<int>(choose_.below(2));
    return aggregate(type, rank, known, depth);
}

std::string ProgramMaker::index(const Datum& datum, int depth) {
    std::string text = "{";
    const TypeOf& num = *catalog_.type("num");
    for (int k = 0; k < datum.rank; ++k) {
        const int dim = datum.dims[static_cast<size_t>(k)];
        if (k > 0) text += ",";
        if (depth > 0 && choose_.chance(30)) // not a constant: one out of bounds is an error of the checker
            text +=
                reference(num, 0, Access::Var, 0) + (choose_.chance(40) ? "+" + expr(num, depth - 1) : "");
        else
            text += std::to_string(1 + choose_.below(dim > 0 ? static_cast<size_t>(dim) : 2));
    }
    return text + "}";
}

bool ProgramMaker::partTo(const TypeOf& from, const TypeOf& wanted, std::string& path, int depth) {
    if (&from == &wanted) return true;
    if (depth == 0 || from.kind != Kind::Record) return false;
    const size_t start = choose_.below(from.parts.size());
    for (size_t i = 0; i < from.parts.size(); ++i) {
        const auto& [name, type] = from.parts[(start + i) % from.parts.size()];
        std::string rest = path + "." + name;
        if (!partTo(*type, wanted, rest, depth - 1)) continue;
        path = std::move(rest);
        return true;
    }
    return false;
}

std::string ProgramMaker::place(const TypeOf& type, bool written, int depth) {
    std::vector<std::string> found;
    const auto look = [&](const Datum& datum) {
        if (datum.isSwitch || (written && !isWritable(datum))) return;
        if (datum.optional && !choose_.chance(5)) return;
        std::string path;
        if (!partTo(*datum.type, type, path, 3)) return;
        found.push_back(datum.name + (datum.rank > 0 ? index(datum, depth - 1) : "") + path);
    };
    // Not all, so that the list stays short.
    const size_t start = globals_.empty() ? 0 : choose_.below(globals_.size());
    for (size_t i = 0; i < globals_.size() && found.size() < 2; ++i)
        look(globals_[(start + i) % globals_.size()]);
    for (const Datum& datum : locals_)
        if (found.size() < 5) look(datum);
    return found.empty() ? "" : found[choose_.below(found.size())];
}

std::string ProgramMaker::expr(const TypeOf& type, int depth) {
    if (--budget_ < 0) depth = 0;
    if (depth > 0 && choose_.chance(45))
        if (std::string found = place(type, false, depth); !found.empty()) return found;
    if (depth > 1 && choose_.chance(15))
        if (std::string call = functionCall(type, depth - 1); !call.empty()) return call;
    if (choose_.chance(15))
        if (const auto& constants = catalog_.constants(type); !constants.empty())
            return choose_.of(constants);
    switch (type.kind) {
    case Kind::Num:
    case Kind::Dnum: return numeric(type, depth);
    case Kind::Bool: return boolean(depth);
    case Kind::String: return text(depth);
    case Kind::Record: return record(type, depth);
    case Kind::Signal: return type.name.substr(6) + "1"; // signaldi: di1
    default: return global(type, 0, Access::Var).name;
    }
}

std::string ProgramMaker::numeric(const TypeOf& type, int depth) {
    if (depth <= 0) return type.name == "byte" ? literal(type, false) : number();
    const auto operand = [&] { return expr(type, depth - 1); };
    switch (choose_.below(14)) {
    case 0:
    case 1: return operand() + "+" + operand();
    case 2: return operand() + "-" + operand();
    case 3:
    case 4: return operand() + "*" + operand();
    case 5: return operand() + "/" + operand();
    case 6: // constants that are not integers are errors of the checker
    case 7: {
        const std::string left = reference(type, 0, Access::Var, 0),
                          right = reference(type, 0, Access::Var, 0);
        return (choose_.chance(30) ? left + "*" + wholeNumber() : left) +
               (choose_.chance(50) ? " DIV " : " MOD ") + (choose_.chance(50) ? wholeNumber() : right);
    }
    case 8: return "-(" + operand() + ")";
    case 9: return "(" + operand() + ")";
    case 10: {
        std::vector<const Datum*> arrays;
        for (const Datum& datum : locals_)
            if (datum.rank > 0 && !datum.optional) arrays.push_back(&datum);
        for (const Datum& datum : globals_)
            if (datum.rank > 0) arrays.push_back(&datum);
        if (type.kind != Kind::Num || arrays.empty()) return number();
        const Datum& array = *choose_.of(arrays);
        return "Dim(" + array.name + "," +
               std::to_string(1 + choose_.below(static_cast<size_t>(array.rank))) + ")";
    }
    case 11: {
        static const std::vector<std::string> kSignals = {"di1", "do1", "ai1", "ao1"};
        if (type.kind == Kind::Dnum) return choose_.chance(50) ? "gi1" : "go1";
        return choose_.of(kSignals);
    }
    default: return number();
    }
}

std::string ProgramMaker::comparison(int depth) {
    static const std::vector<std::string> kOrders = {"<", "<=", ">", ">=", "=", "<>"};
    static const std::vector<std::string> kEqualities = {"=", "<>"};
    const TypeOf& type = *choose_.of(types_);
    const bool ordered = type.kind == Kind::Num || type.kind == Kind::Dnum;
    std::string left = type.kind == Kind::Record ? place(type, false, depth) : expr(type, depth - 1);
    if (left.empty()) return "TRUE";
    return "(" + left + (ordered ? choose_.of(kOrders) : choose_.of(kEqualities)) + expr(type, depth - 1) +
           ")";
}

std::string ProgramMaker::boolean(int depth) {
    if (depth <= 0) return choose_.chance(50) ? "TRUE" : "FALSE";
    switch (choose_.below(8)) {
    case 0:
    case 1:
    case 2: return comparison(depth);
    case 3: return "(" + boolean(depth - 1) + " AND " + boolean(depth - 1) + ")";
    case 4: return "(" + boolean(depth - 1) + " OR " + boolean(depth - 1) + ")";
    case 5: return "(" + boolean(depth - 1) + " XOR " + boolean(depth - 1) + ")";
    case 6: return "(NOT " + boolean(depth - 1) + ")";
    default:
        for (const Datum& datum : locals_)
            if (datum.optional && choose_.chance(50)) return "Present(" + datum.name + ")";
        return choose_.chance(50) ? "TRUE" : "FALSE";
    }
}

std::string ProgramMaker::text(int depth) {
    const TypeOf& string = *catalog_.type("string");
    if (depth <= 0) return literal(string, false);
    switch (choose_.below(5)) {
    case 0: return expr(string, depth - 1) + "+" + expr(string, depth - 1);
    case 1:
        return "NumToStr(" + expr(*catalog_.type("num"), depth - 1) + "," + std::to_string(choose_.below(5)) +
               ")";
    case 2:
        if (std::string data = place(*choose_.of(types_), false, depth); !data.empty())
            return "ValToStr(" + data + ")";
        break;
    default: break;
    }
    return literal(string, false);
}

std::string ProgramMaker::record(const TypeOf& type, int depth) {
    const TypeOf& num = *catalog_.type("num");
    if (depth > 0 && (type.name == "pos" || type.name == "orient")) {
        // An aggregate gets its type from its context: an operand is data or a call.
        const auto operand = [&] {
            std::string found = place(type, false, depth);
            return found.empty() ? global(type, 0, Access::Var).name : found;
        };
        switch (choose_.below(8)) {
        case 0: return operand() + "*" + operand();
        case 1:
            if (type.name == "pos") return operand() + "+" + operand();
            break;
        case 2:
            if (type.name == "pos") return operand() + "-" + operand();
            break;
        case 3:
            if (type.name == "pos") return expr(num, 0) + "*" + operand();
            break;
        case 4:
            if (type.name == "pos") return operand() + "/" + expr(num, 0);
            break;
        case 5:
            if (type.name == "pos") return "-" + operand();
            break;
        default: break;
        }
    }
    std::string made = "[";
    for (size_t i = 0; i < type.parts.size(); ++i)
        made += (i > 0 ? "," : "") +
                (depth > 0 ? expr(*type.parts[i].second, depth - 1) : literal(*type.parts[i].second, false));
    return made + "]";
}

} // namespace rapid::fuzz
