// Instructions.

#include "tests/fuzz/program_maker.h"

namespace rapid::fuzz {

void ProgramMaker::line(const std::string& text) {
    body_ += std::string(static_cast<size_t>(indent_) * 2, ' ') + text + "\n";
}

void ProgramMaker::statements(int count, int depth) {
    for (int i = 0; i < count; ++i)
        statement(depth);
}

void ProgramMaker::statement(int depth) {
    if (--budget_ < 0 || depth > 4) return line("calls:=calls+1;");
    const bool calls = part_ == Part::Body || part_ == Part::Error;
    switch (choose_.below(26)) {
    case 0:
    case 1:
    case 2:
    case 3:
    case 4:
    case 5: return assignment();
    case 6:
    case 7:
    case 8: return branch(depth);
    case 9: return test(depth);
    case 10:
    case 11: return loop(depth);
    case 12: return whileLoop(depth);
    case 13: return jump(depth);
    case 14:
    case 15: return print();
    case 16: return raise();
    case 17: return useOptional();
    case 18: return useUnknown();
    case 19: return usePlaceholder();
    case 20: return useInterrupt();
    case 21: return calls ? line(lateCall()) : print();
    default: {
        const std::string call = calls ? procedureCall() : "";
        return call.empty() ? assignment() : line(call);
    }
    }
}

void ProgramMaker::assignment() {
    if (choose_.chance(20)) { // a whole array
        std::vector<const Datum*> arrays;
        for (const Datum& datum : locals_)
            if (datum.rank > 0 && !datum.optional && isWritable(datum)) arrays.push_back(&datum);
        for (const Datum& datum : globals_)
            if (datum.rank > 0 && isWritable(datum) && datum.type->isValue) arrays.push_back(&datum);
        if (!arrays.empty()) {
            const Datum& array = *choose_.of(arrays);
            return line(array.name + ":=" + arrayValue(*array.type, array.rank, array.dims, 3) + ";");
        }
    }
    const TypeOf& type = *anyType();
    std::string target = place(type, true, 2);
    if (target.empty()) target = global(type, 0, Access::Var).name;
    line(target + ":=" + expr(type, 4) + ";");
}

void ProgramMaker::branch(int depth) {
    if (choose_.chance(25)) {
        const std::string target = place(*catalog_.type("num"), true, 1);
        return line("IF " + boolean(3) + " " + (target.empty() ? "calls" : target) + ":=" + number() + ";");
    }
    line("IF " + boolean(3) + " THEN");
    const auto body = [&](int most) {
        ++indent_;
        statements(static_cast<int>(choose_.below(static_cast<size_t>(most))), depth + 1);
        --indent_;
    };
    body(4);
    while (choose_.chance(25)) {
        line(choose_.chance(5) ? "<EIT>" : "ELSEIF " + boolean(3) + " THEN");
        body(3);
    }
    if (choose_.chance(40)) {
        line("ELSE");
        body(3);
    }
    line("ENDIF");
}

void ProgramMaker::test(int depth) {
    const TypeOf& type = *anyType();
    if (type.kind == Kind::Record && !choose_.chance(20)) return assignment();
    const bool atomic = type.kind != Kind::Record;
    std::string subject = atomic ? expr(type, 3) : place(type, false, 2);
    if (subject.empty()) return assignment();
    line("TEST " + subject);
    const size_t cases = choose_.below(4);
    for (size_t i = 0; i < cases; ++i) {
        // Equal constants are an error of the checker.
        const std::string value = type.kind == Kind::Num || type.kind == Kind::Dnum
                                      ? std::to_string(i * 3) + "," + std::to_string(i * 3 + 1)
                                  : type.kind == Kind::String ? "\"" + std::to_string(i) + "\""
                                                              : expr(type, 1);
        if (type.kind == Kind::Bool && i > 0) break;
        line("CASE " + value + ":");
        ++indent_;
        statements(static_cast<int>(choose_.below(3)), depth + 1);
        --indent_;
    }
    if (choose_.chance(50)) {
        line("DEFAULT:");
        ++indent_;
        statements(static_cast<int>(choose_.below(3)), depth + 1);
        --indent_;
    }
    line("ENDTEST");
}

void ProgramMaker::loop(int depth) {
    const TypeOf& num = *catalog_.type("num");
    const std::string name = "i" + std::to_string(names_++);
    static const std::vector<std::string> kStarts = {"1", "0", "3", "-2", "1.5", "10"};
    static const std::vector<std::string> kSteps = {"",        "",          " STEP 1", " STEP -1",
                                                    " STEP 2", " STEP 0.5", " STEP -3"};
    const std::string from = choose_.chance(75) ? choose_.of(kStarts) : expr(num, 2);
    const std::string to = choose_.chance(75) ? choose_.of(kStarts) : "4-(" + expr(num, 2) + ")";
    const std::string step = choose_.chance(10) ? " STEP " + expr(num, 2) : choose_.of(kSteps);
    line("FOR " + name + " FROM " + from + " TO " + to + step + " DO");
    Datum variable;
    variable.name = name;
    variable.type = &num;
    variable.access = Access::Loop;
    locals_.push_back(variable);
    ++indent_;
    ++loopDepth_;
    line("calls:=calls+1;");
    line("IF calls>200 BREAK;");
    if (choose_.chance(15)) line("IF " + boolean(2) + " CONTINUE;");
    statements(static_cast<int>(choose_.below(4)), depth + 1);
    --loopDepth_;
    --indent_;
    std::erase_if(locals_, [&](const Datum& datum) { return datum.name == name; });
    line("ENDFOR");
}

void ProgramMaker::whileLoop(int depth) {
    const std::string name = "w" + std::to_string(names_++);
    counters_ += "    VAR num " + name + ";\n";
    line("WHILE " + name + "<" + std::to_string(1 + choose_.below(5)) +
         (choose_.chance(50) ? " AND " + boolean(2) : "") + " DO");
    ++indent_;
    ++loopDepth_;
    line(name + ":=" + name + "+1;");
    statements(static_cast<int>(choose_.below(4)), depth + 1);
    if (choose_.chance(20)) line("IF " + boolean(2) + " BREAK;");
    --loopDepth_;
    --indent_;
    line("ENDWHILE");
}

void ProgramMaker::jump(int depth) {
    const std::string label = "j" + std::to_string(names_++);
    if (choose_.chance(50)) { // forward
        line("IF " + boolean(2) + " GOTO " + label + ";");
        statements(static_cast<int>(choose_.below(3)), depth + 1);
        line(label + ":");
        return;
    }
    const std::string name = "w" + std::to_string(names_++);
    counters_ += "    VAR num " + name + ";\n";
    line(label + ":");
    line(name + ":=" + name + "+1;");
    statements(static_cast<int>(choose_.below(3)), depth + 1);
    line("IF " + name + "<3 GOTO " + label + ";");
}

void ProgramMaker::print() {
    switch (choose_.below(5)) {
    case 0: return line("TPWrite \"n \"\\Num:=" + expr(*catalog_.type("num"), 3) + ";");
    case 1: return line("TPWrite \"d \"\\Dnum:=" + expr(*catalog_.type("dnum"), 3) + ";");
    case 2: return line("TPWrite \"b \"\\Bool:=" + boolean(3) + ";");
    case 3: return line("TPWrite \"p \"\\Pos:=" + expr(*catalog_.type("pos"), 3) + ";");
    default: return line("TPWrite " + text(3) + ";");
    }
}

void ProgramMaker::raise() {
    if (part_ == Part::Undo || part_ == Part::Backward) return print();
    switch (choose_.below(4)) {
    case 0: return line("IF " + boolean(2) + " RAISE " + std::to_string(1 + choose_.below(90)) + ";");
    case 1: return line("IF " + boolean(2) + " RAISE ERR_DIVZERO;");
    case 2: return line("IF FALSE EXIT;");
    default:
        return line("IF " + boolean(2) + (sub_->result ? " RETURN " + expr(*sub_->result, 2) : " RETURN") +
                    ";");
    }
}

/// An optional parameter, tested or not.
void ProgramMaker::useOptional() {
    for (const Datum& datum : locals_) {
        if (!datum.optional || datum.isSwitch || datum.rank > 0 || !datum.type->isValue ||
            !choose_.chance(50))
            continue;
        const std::string target = reference(*datum.type, 0, Access::Var, 1);
        return line("IF Present(" + datum.name + ") " + target + ":=" + datum.name + ";");
    }
    assignment();
}

/// Names that an add-in may declare.
void ProgramMaker::useUnknown() {
    const std::string target = global(*catalog_.type("num"), 0, Access::Var).name;
    switch (choose_.below(7)) {
    case 0: return line("Hand_GripInward;");
    case 1: return line("Hand_JogInward " + text(2) + ",[1,2]\\NoWait;");
    case 2: return line(target + ":=ERR_HAND_NOTCALIBRATED;");
    case 3: return line("IF Hand_IsCalibrated() " + target + ":=1;");
    case 4: return line("IF " + target + "=ERR_HAND_NOTCALIBRATED AND " + boolean(2) + " " + target + ":=2;");
    case 5: return line("FOR k FROM 1 TO Hand_GetActualPos() DO " + target + ":=k; ENDFOR");
    default: return line(target + ":=1+Hand_GetActualPos()*2;");
    }
}

void ProgramMaker::usePlaceholder() {
    if (!choose_.chance(30)) return assignment();
    const std::string target = global(*catalog_.type("num"), 0, Access::Var).name;
    switch (choose_.below(9)) {
    case 0: return line("<SMT>");
    case 1: return line(target + ":=<EXP>;");
    case 2: return line(target + ":=<ID>;");
    case 3: return line("<VAR>:=1;");
    case 4: return line("TPWrite <ARG>;");
    case 5: return line("IF <EXP> " + target + ":=1;");
    case 6: return line(target + ":=Abs(<ID>);");
    case 7: return line("WHILE <EXP> DO " + target + ":=1; ENDWHILE");
    default: return line(target + ":=<ID>.x;");
    }
}

void ProgramMaker::useInterrupt() {
    std::string trap;
    for (const Sub& sub : subs_)
        if (sub.isTrap) trap = sub.name;
    const TypeOf* intnum = catalog_.type("intnum");
    if (trap.empty() || !intnum || part_ != Part::Body) return assignment();
    const std::string number = global(*intnum, 0, Access::Var).name;
    line("IDelete " + number + ";");
    line("CONNECT " + number + " WITH " + trap + ";");
    switch (choose_.below(4)) {
    case 0: return line("ITimer\\Single,0.1," + number + ";");
    case 1: return line("ISignalDO do1,1," + number + ";");
    case 2: return line("IPers sharedNum," + number + ";");
    default: return line("ISignalDI\\Single,di1,edge," + number + ";");
    }
}

} // namespace rapid::fuzz
