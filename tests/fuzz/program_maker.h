#pragma once
// Makes well-typed RAPID programs from bytes: the fuzzer mutates the bytes, every choice is one of them. When they are used
// up, the simplest choices end the program.

#include "frontend/sema/checked.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace rapid::fuzz {

/// The bytes that steer the choices.
class Choices {
  public:
    Choices(const uint8_t* data, size_t size) : data_(data), size_(size) {}
    uint8_t byte() { return next_ < size_ ? data_[next_++] : uint8_t{0}; }
    bool empty() const { return next_ >= size_; }
    /// 0 to n - 1; 0 when the bytes are used up.
    size_t below(size_t n) {
        if (n <= 1) return 0;
        const size_t value = n > 256 ? byte() * size_t{256} + byte() : byte();
        return value % n;
    }
    bool chance(unsigned percent) { return !empty() && byte() % 100 < percent; }
    template <class T> const T& of(const std::vector<T>& list) { return list[below(list.size())]; }

  private:
    const uint8_t* data_;
    size_t size_;
    size_t next_ = 0;
};

enum class Kind : uint8_t { Num, Dnum, Bool, String, Record, Handle, Signal };

struct TypeOf {
    std::string name;
    Kind kind = Kind::Num;
    std::vector<std::pair<std::string, const TypeOf*>> parts; ///< of a record
    bool isValue = true;
};

enum class Access : uint8_t { Const, Var, Pers, In, ByVar, ByPers, Inout, Loop };

struct Datum {
    std::string name;
    const TypeOf* type = nullptr;
    int rank = 0;
    std::array<int, 3> dims{}; ///< 0: conformant
    Access access = Access::Var;
    bool optional = false;
    bool isSwitch = false;
    int group = 0; ///< parameters that exclude each other
};

struct Sub {
    std::string name;
    const TypeOf* result = nullptr; ///< functions
    std::vector<Datum> params;
    bool isTrap = false;
    int module = 0;
    bool isLocal = false;
};

/// The routines and data of the standard library, from its declarations.
class Catalog {
  public:
    /// `implemented`: is there a native of this name?
    Catalog(const sema::CheckedProgram& library, bool (*implemented)(std::string_view name));
    const TypeOf* type(std::string_view name) const;
    const TypeOf* typeOf(const sema::Type& type) const;
    const std::vector<const sema::RoutineSymbol*>& procedures() const { return procedures_; }
    const std::vector<const sema::RoutineSymbol*>& functions(const TypeOf& result) const;
    const std::vector<std::string>& constants(const TypeOf& type) const;

  private:
    const TypeOf* add(const sema::Type& type);
    std::deque<TypeOf> types_;
    std::map<std::string, const TypeOf*, std::less<>> byName_;
    std::vector<const sema::RoutineSymbol*> procedures_;
    std::map<const TypeOf*, std::vector<const sema::RoutineSymbol*>> functions_;
    std::map<const TypeOf*, std::vector<std::string>> constants_;
};

struct MadeProgram {
    /// Texts of the modules of each task.
    std::vector<std::vector<std::string>> tasks;
    bool optimise = false; ///< the optimiser takes most of the time
    bool hasTime = false;  ///< what it prints hangs on the time of day
};

class ProgramMaker {
  public:
    ProgramMaker(const Catalog& catalog, const uint8_t* data, size_t size);
    MadeProgram make();

  private:
    // program_maker.cpp: declarations
    struct Text {
        std::string types, data, routines;
    };
    void makeTypes();
    void makeData();
    void makeSubs(int from);
    std::string makeModule(int number);
    std::string declare(const Datum& datum);
    std::string signature(const Sub& sub);
    void writeSub(const Sub& sub, size_t number);
    void writeMain();
    void dumpData(std::string& out);
    std::string handlers(const Sub& sub);
    Datum randomDatum(const std::string& prefix, bool param);
    const TypeOf* anyType(bool value = true);
    const Datum& global(const TypeOf& type, int rank, Access access);

    // maker_values.cpp: expressions
    std::string expr(const TypeOf& type, int depth);
    std::string numeric(const TypeOf& type, int depth);
    std::string boolean(int depth);
    std::string text(int depth);
    std::string record(const TypeOf& type, int depth);
    std::string literal(const TypeOf& type, bool constant);
    std::string arrayValue(const TypeOf& type, int rank, const std::array<int, 3>& dims, int depth);
    std::string aggregate(const TypeOf& type, int rank, std::array<int, 3> dims, int depth);
    std::string index(const Datum& datum, int depth);
    /// Data of the type, or a part of data; empty when there is none. `written`: it is assigned or passed by reference.
    std::string place(const TypeOf& type, bool written, int depth);
    bool partTo(const TypeOf& from, const TypeOf& wanted, std::string& path, int depth);
    static bool isWritable(const Datum& datum);
    std::string comparison(int depth);
    std::string number();
    std::string wholeNumber();

    // maker_calls.cpp
    std::string builtInCall(const sema::RoutineSymbol& routine, int depth, bool& possible);
    std::string builtInArgument(const sema::DataSymbol& param, int depth, bool& possible);
    std::string anyArgument(const sema::DataSymbol& param, int depth, bool& possible);
    std::string arguments(const Sub& sub, int depth);
    std::string argument(const Datum& param, int depth);
    std::string functionCall(const TypeOf& type, int depth);
    std::string procedureCall();
    std::string lateCall();
    std::string reference(const TypeOf& type, int rank, Access access, int depth);

    // maker_statements.cpp
    void statements(int count, int depth);
    void statement(int depth);
    void assignment();
    void branch(int depth);
    void test(int depth);
    void loop(int depth);
    void whileLoop(int depth);
    void jump(int depth);
    void print();
    void raise();
    void useOptional();
    void useUnknown();
    void usePlaceholder();
    void useInterrupt();
    void line(const std::string& text);

    const Catalog& catalog_;
    Choices choose_;
    MadeProgram made_;
    std::deque<TypeOf> ownTypes_;
    std::vector<const TypeOf*> types_; ///< that data may have
    std::deque<Datum> globals_;
    std::vector<int> globalModule_;
    std::deque<Sub> subs_;
    std::vector<Text> modules_;
    // of the routine that is being written
    const Sub* sub_ = nullptr;
    size_t subNumber_ = 0;
    int module_ = 0;
    std::vector<Datum> locals_;
    std::string body_;
    std::string counters_; ///< declarations of counters
    int indent_ = 0, loopDepth_ = 0, names_ = 0, budget_ = 0;
    enum class Part : uint8_t { Body, Error, Undo, Backward } part_ = Part::Body;
    bool constantOnly_ = false;
    std::set<std::string> onDemand_;
};

} // namespace rapid::fuzz
