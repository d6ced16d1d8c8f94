#include "tests/fuzz/tasks_maker.h"

namespace rapid::fuzz {

namespace {

constexpr size_t kProcedures = 4; // of each task; each calls only those after it, so that recursion ends
constexpr size_t kTraps = 2;

std::string named(const char* stem, size_t number) {
    return stem + std::to_string(number);
}

} // namespace

TaskTexts TasksMaker::make() {
    tasks_ = 2 + choose_.below(2);
    if (choose_.chance(40)) planSections();
    TaskTexts texts;
    for (task_ = 1; task_ <= tasks_; ++task_)
        texts.push_back({module(task_)});
    return texts;
}

void TasksMaker::line(const std::string& text) {
    text_ += std::string(static_cast<size_t>(indent_) * 2, ' ') + text + "\n";
}

std::string TasksMaker::module(size_t task) {
    text_.clear();
    budget_ = 60;
    indent_ = 0;
    line("MODULE M" + std::to_string(task));
    indent_ = 1;
    for (const char* data : {"PERS num shared1 := 0;", "PERS num shared2 := 0;", "PERS num shared3 := 0;",
                             "PERS bool lock := FALSE;", "VAR num a := 1;", "VAR num b := 2;",
                             "VAR num c := 3;", "VAR num list{3} := [1, 2, 3];", "VAR num tries := 0;",
                             "VAR bool late := FALSE;", "VAR errnum OWN := -1;", "VAR intnum tick1;",
                             "VAR intnum tick2;", "VAR clock watch;", "VAR syncident meet;"})
        line(data);
    std::string members;
    for (size_t i = 1; i <= tasks_; ++i)
        members += (i == 1 ? "[\"" : ", [\"") + named(i <= robots_ ? "T_ROB" : "T_", i) + "\"]";
    line("PERS tasks all{" + std::to_string(tasks_) + "} := [" + members + "];");
    if (robots_ > 1) line("PERS tasks robots{2} := [[\"T_ROB1\"], [\"T_ROB2\"]];");
    for (size_t i = 1; i <= sections_.size() && task <= robots_; ++i)
        line("VAR syncident on" + std::to_string(i) + "; VAR syncident off" + std::to_string(i) + ";");
    if (task <= robots_)
        line("CONST jointtarget home := [[0, 0, 0, 0, 30, 0], [9E9, 9E9, 9E9, 9E9, 9E9, 9E9]];");
    for (size_t i = 1; i <= kTraps; ++i)
        writeTrap(i);
    writeFunction();
    for (size_t i = kProcedures; i >= 1; --i)
        writeProcedure(i);
    writeMain();
    indent_ = 0;
    line("ENDMODULE");
    return text_;
}

/// A routine's first line, and then its body: the counters of its loops are declared between them.
void TasksMaker::begin(const std::string& head) {
    line(head);
    declarations_ = text_.size();
    counters_.clear();
    ++indent_;
}

void TasksMaker::end(const char* last) {
    text_.insert(declarations_, counters_);
    line(last);
}

void TasksMaker::writeTrap(size_t number) {
    part_ = Part::Trap;
    level_ = kProcedures;
    begin(named("TRAP onTick", number));
    line("TPWrite \"T" + std::to_string(task_) + " trap " + std::to_string(number) + " \" + ValToStr(" +
         shared() + ");");
    statements(choose_.below(3), 2);
    --indent_;
    end("ENDTRAP");
}

void TasksMaker::writeFunction() {
    part_ = Part::Body;
    level_ = kProcedures;
    begin("FUNC num f(num x)");
    statements(choose_.below(3), 2);
    line("IF x > 9 RETURN x - list{Trunc(x) MOD 3 + 1};");
    line("RETURN x + " + number() + ";");
    --indent_;
    end("ENDFUNC");
}

/// The caller gets an error that is not handled here; main handles all.
void TasksMaker::errorHandler(size_t number) {
    line("ERROR");
    ++indent_;
    part_ = Part::Error;
    line("TPWrite \"T" + std::to_string(task_) + " p" + std::to_string(number) +
         " error \" + ValToStr(ERRNO = OWN);");
    statements(choose_.below(2), 2);
    switch (choose_.below(4)) {
    case 0: line("TRYNEXT;"); break;
    case 1:
        line("Incr tries;");
        line("IF tries MOD 3 <> 0 RETRY;");
        line("TRYNEXT;");
        break;
    case 2: line("RETURN;"); break;
    default: line("RAISE;");
    }
    --indent_;
    part_ = Part::Body;
}

void TasksMaker::writeProcedure(size_t number) {
    part_ = Part::Body;
    level_ = number;
    begin(named("PROC p", number) + "()");
    statements(2 + choose_.below(5), 0);
    --indent_;
    if (choose_.chance(60)) errorHandler(number);
    if (choose_.chance(25)) {
        line("UNDO");
        ++indent_;
        line("TPWrite \"T" + std::to_string(task_) + " undo " + std::to_string(number) + "\";");
        line(shared() + " := " + this->number() + ";");
        --indent_;
    }
    end("ENDPROC");
}

void TasksMaker::writeMain() {
    part_ = Part::Body;
    level_ = 0;
    begin("PROC main()");
    line("BookErrNo OWN;");
    line("ClkStart watch;");
    line("CONNECT tick1 WITH onTick1;");
    line("CONNECT tick2 WITH onTick2;");
    if (task_ <= robots_) {
        line("ConfJ \\Off;");
        line("ConfL \\Off;");
    }
    for (size_t i = 1; i <= sections_.size() && task_ <= robots_; ++i) {
        statements(choose_.below(4), 0);
        section(i);
    }
    statements(6 + choose_.below(8), 0);
    line("TPWrite \"T" + std::to_string(task_) +
         " ended \" + ValToStr(shared1 + shared2) + \" \" + ValToStr(a);");
    --indent_;
    line("ERROR");
    ++indent_;
    line("TPWrite \"T" + std::to_string(task_) + " main error \" + ValToStr(ERRNO);");
    line("TRYNEXT;");
    --indent_;
    end("ENDPROC");
}

// ---- Statements ----------------------------------------------------------------------------------------------------

void TasksMaker::statements(size_t count, int depth) {
    for (size_t i = 0; i < count && budget_ > 0; ++i) {
        --budget_;
        statement(depth);
    }
}

void TasksMaker::statement(int depth) {
    const bool isBody = part_ == Part::Body;
    switch (choose_.below(16)) {
    case 0:
    case 1: return compute();
    case 2:
    case 3: return print();
    case 4: return wait();
    case 5:
    case 6: return signal();
    case 7: return share();
    case 8: return isBody ? interrupt() : print();
    case 9: return isBody && depth < 3 ? critical(depth) : share();
    case 10: return isBody ? fail() : compute();
    case 11: return isBody ? call() : print();
    case 12: return depth < 3 ? loop(depth) : compute();
    case 13: return depth < 3 ? branch(depth) : print();
    case 14: return isBody && task_ <= robots_ ? move() : signal();
    default: return isBody && task_ <= robots_ ? stopAndStart() : isBody ? waitForTasks() : print();
    }
}

std::string TasksMaker::number() {
    return std::to_string(1 + choose_.below(9));
}

std::string TasksMaker::value() {
    switch (choose_.below(6)) {
    case 0: return number();
    case 1: return local();
    case 2: return shared();
    case 3: return "(" + local() + " + " + shared() + ") MOD 7";
    case 4: return "list{" + std::to_string(1 + choose_.below(3)) + "}";
    default: return "Trunc(" + local() + " / " + number() + ")";
    }
}

std::string TasksMaker::condition() {
    switch (choose_.below(5)) {
    case 0: return local() + " > " + number();
    case 1: return shared() + " MOD 2 = 0";
    case 2: return "DOutput(" + digital() + ") = 1";
    case 3: return "lock";
    default: return shared() + " <= " + local();
    }
}

std::string TasksMaker::seconds() {
    constexpr const char* kTimes[] = {"0.004", "0.01", "0.02", "0.05", "0.1", "0.0333"};
    return kTimes[choose_.below(std::size(kTimes))];
}

void TasksMaker::compute() {
    switch (choose_.below(4)) {
    case 0: return line("Incr " + local() + ";");
    case 1: return line(local() + " := (" + local() + " * 3 + " + value() + ") MOD 50;");
    case 2: return line("list{" + local() + " MOD 3 + 1} := " + value() + ";");
    default:
        // the function of a trap or a handler would interrupt itself
        line(local() +
             " := " + (part_ == Part::Body && level_ < kProcedures ? "f(" + local() + ")" : value()) + ";");
    }
}

void TasksMaker::print() {
    line("TPWrite \"T" + std::to_string(task_) + " \" + ValToStr(" + value() + ")" +
         (choose_.chance(30) ? " + \" at \" + NumToStr(ClkRead(watch), 3);" : ";"));
}

void TasksMaker::wait() {
    const std::string longest = " \\MaxTime:=" + seconds();
    const std::string flag = choose_.chance(50) || part_ != Part::Body ? " \\TimeFlag:=late" : "";
    switch (choose_.below(5)) {
    case 0:
        return line("WaitDO " + digital() + ", " + std::to_string(choose_.below(2)) + longest + flag + ";");
    case 1: return line("WaitUntil " + condition() + longest + flag + ";");
    case 2: return line("WaitUntil " + shared() + " > " + number() + longest + flag + " \\PollRate:=0.04;");
    default: return line("WaitTime " + seconds() + ";");
    }
}

void TasksMaker::waitForTasks() {
    line("WaitSyncTask meet, all \\TimeOut:=0.3;");
}

void TasksMaker::signal() {
    const std::string bit = std::to_string(choose_.below(2));
    switch (choose_.below(6)) {
    case 0: return line("PulseDO \\PLength:=" + seconds() + ", " + digital() + ";");
    case 1: return line("SetGO go" + std::to_string(1 + choose_.below(2)) + ", " + number() + ";");
    case 2: return line("SetDO \\SDelay:=" + seconds() + ", " + digital() + ", " + bit + ";");
    case 3: return line("InvertDO " + digital() + ";");
    case 4: return line("SetAO ao1, " + number() + ";");
    default: return line("SetDO " + digital() + ", " + bit + ";");
    }
}

void TasksMaker::share() {
    const std::string to = shared();
    line(to + " := (" + to + " + " + value() + ") MOD 100;");
}

void TasksMaker::critical(int depth) {
    line("IF TestAndSet(lock) THEN");
    ++indent_;
    // no statement that fails or calls: the lock would stay
    const Part part = part_;
    part_ = Part::Trap;
    statements(1 + choose_.below(3), depth + 1);
    part_ = part;
    line("lock := FALSE;");
    --indent_;
    line("ENDIF");
}

void TasksMaker::interrupt() {
    const std::string tick = "tick" + std::to_string(1 + choose_.below(2));
    switch (choose_.below(7)) {
    case 0:
        line("IDelete " + tick + ";");
        line("CONNECT " + tick + " WITH onTick" + tick.substr(4) + ";");
        return line("ITimer 0.1" + number() + ", " + tick + ";");
    case 1:
        line("IDelete " + tick + ";");
        line("CONNECT " + tick + " WITH onTick" + tick.substr(4) + ";");
        return line("ISignalDO " + digital() + ", " + (choose_.chance(50) ? "1" : "edge") + ", " + tick +
                    ";");
    case 2:
        line("IDelete " + tick + ";");
        line("CONNECT " + tick + " WITH onTick" + tick.substr(4) + ";");
        return line("IPers " + shared() + ", " + tick + ";");
    case 3:
        line("IDisable;");
        line("WaitTime " + seconds() + ";");
        return line("IEnable;");
    case 4:
        line("ISleep " + tick + ";");
        print();
        return line("IWatch " + tick + ";");
    case 5:
        line("IDelete " + tick + ";");
        line("CONNECT " + tick + " WITH onTick" + tick.substr(4) + ";");
        return line("ITimer \\Single, 0.0" + number() + ", " + tick + ";");
    default: return line("IDelete " + tick + ";");
    }
}

void TasksMaker::fail() {
    switch (choose_.below(5)) {
    case 0: return line("IF " + condition() + " RAISE OWN;");
    case 1: return line(local() + " := 10 DIV (" + local() + " MOD 3);");
    case 2: return line("list{" + local() + " MOD 5} := 1;");
    case 3: return line("SetGO go1, 300;");
    default: return line("WaitDO " + digital() + ", 1 \\MaxTime:=" + seconds() + ";");
    }
}

void TasksMaker::call() {
    if (level_ >= kProcedures) return compute();
    const std::string name = named("p", level_ + 1 + choose_.below(kProcedures - level_));
    line(choose_.chance(20) ? "%\"" + name + "\"%;" : name + ";");
}

void TasksMaker::loop(int depth) {
    const std::string counter = "i" + std::to_string(++loops_);
    const size_t kind = choose_.below(3);
    if (kind == 0) line("FOR " + counter + " FROM 1 TO " + number() + " DO");
    if (kind == 1) line("FOR " + counter + " FROM " + number() + " TO 1 STEP -2 DO");
    if (kind == 2) line("WHILE " + counter + " < " + number() + " DO");
    ++indent_;
    if (kind == 2) line(counter + " := " + counter + " + 1;");
    statements(1 + choose_.below(3), depth + 1);
    --indent_;
    line(kind == 2 ? "ENDWHILE" : "ENDFOR");
    if (kind == 2) counters_ += "    VAR num " + counter + " := 0;\n";
}

void TasksMaker::branch(int depth) {
    line("IF " + condition() + " THEN");
    ++indent_;
    statements(1 + choose_.below(2), depth + 1);
    --indent_;
    if (choose_.chance(50)) {
        line("ELSE");
        ++indent_;
        statements(1 + choose_.below(2), depth + 1);
        --indent_;
    }
    line("ENDIF");
}

namespace {

constexpr const char* kZones[] = {"fine", "z10", "z50", "z1"};
constexpr const char* kSpeeds[] = {"v200", "v500", "v1000", "v100"};

} // namespace

std::string TasksMaker::target() {
    const std::string x = std::to_string(5 * static_cast<int>(choose_.below(8))),
                      z = std::to_string(5 * static_cast<int>(choose_.below(8)));
    return "Offs(CalcRobT(home, tool0), -" + x + ", " + z + ", -" + z + ")";
}

void TasksMaker::move() {
    const std::string end =
        std::string(", ") + kSpeeds[choose_.below(4)] + ", " + kZones[choose_.below(4)] + ", tool0";
    const std::string to = target();
    switch (choose_.below(6)) {
    case 0: return line("MoveAbsJ home" + end + ";");
    case 1: return line("MoveJ " + to + end + ";");
    case 2: return line("MoveLDO " + to + end + ", " + digital() + ", 1;");
    case 3: return line("WaitRob \\InPos;");
    case 4: return line("MoveLSync " + to + end + ", \"p4\";");
    default: return line("MoveL " + to + end + ";");
    }
}

void TasksMaker::stopAndStart() {
    line("StopMove;");
    line("WaitTime " + seconds() + ";");
    line("StartMove;");
}

// ---- Robots that move together --------------------------------------------------------------------------------------

void TasksMaker::planSections() {
    robots_ = 2;
    for (size_t i = 1 + choose_.below(2); i > 0; --i)
        sections_.push_back(1 + choose_.below(6));
}

/// One movement of each identity, with statements of this robot's task between them that neither move nor call.
void TasksMaker::section(size_t number) {
    const std::string which = std::to_string(number);
    line("SyncMoveOn on" + which + ", robots" + (choose_.chance(20) ? " \\TimeOut:=5;" : ";"));
    part_ = Part::Trap;
    bool isStored = false;
    for (size_t i = 1; i <= sections_[number - 1]; ++i) {
        // a path put aside lasts for one movement, in all tasks the same one
        if (isStored) line("RestoPath; StartMove;");
        isStored = !isStored && i % 3 == 2 && number == 2;
        if (isStored) line("StorePath \\KeepSync;");
        statements(choose_.below(3), 1);
        if (choose_.chance(15)) stopAndStart();
        if (isStored && choose_.chance(30)) {
            line("SyncMoveSuspend;");
            line("MoveL " + target() + ", v200, fine, tool0;");
            line("SyncMoveResume;");
        }
        moveTogether(static_cast<int>(number * 100 + i * 10), isStored);
    }
    if (isStored) line("RestoPath; StartMove;");
    part_ = Part::Body;
    line("SyncMoveOff off" + which + ";");
}

void TasksMaker::moveTogether(int id, bool isStop) {
    const std::string with = " \\ID:=" + std::to_string(id) + ", " + kSpeeds[choose_.below(4)] + ", ";
    const std::string end = with + (isStop ? "fine" : kZones[choose_.below(4)]) + ", tool0";
    switch (choose_.below(9)) {
    case 0: return line("MoveAbsJ home" + end + ";");
    case 1: return line("MoveJ " + target() + end + ";");
    case 2: return line("MoveLDO " + target() + end + ", " + digital() + ", 1;");
    case 3: return line("MoveC " + target() + ", " + target() + end + ";");
    default: return line("MoveL " + target() + end + ";");
    }
}

} // namespace rapid::fuzz
