// The resources around RAPID, without HTTP: what serve-contract.md (lines named) and controller.md chapter 2 say of them.

#include "unit/rws/served_controller.h"

#include <catch2/catch.hpp>

using namespace rapidc::rws;

TEST_CASE("Execution, tasks and pointers (controller.md 2.3, serve-contract 25)", "[rws]") {
    ServedController served(kModules);
    REQUIRE(served.opened());
    CHECK(served.read(kOld, "/rw/rapid/execution", "ctrlexecstate", "rap-execution") == "stopped");
    CHECK(served.read(kOld, "/rw/rapid/tasks", "type", "rap-task-li") == "norm");
    CHECK(served.read(kOld, "/rw/rapid/tasks", "excstate", "rap-task-li") == "read");
    CHECK(served.read(kNew, "/rw/rapid/tasks", "type", "rap-task-li") == "normal");
    CHECK(served.read(kNew, "/rw/rapid/tasks/T_ROB1", "motiontask", "rap-task") == "TRUE");
    CHECK(served.read(kNew, "/rw/rapid/tasks/T_ROB1/pcp", "beginposition", "pcp-info") == "16,7");
    CHECK(served.read(kNew, "/rw/rapid/tasks/T_ROB1/pcp", "endposition", "pcp-info") == "16,17");
    CHECK(served.read(kNew, "/rw/rapid/tasks/T_ROB1/pcp", "modulemame", "pcp-info") == "Main1");
    CHECK(served.post(kOld, "/rw/rapid/execution?action=start", {}).failure->code ==
          ReturnCode::StartRefused);
    CHECK(served.post(kOld, "/rw/panel/ctrlstate?action=setctrlstate", {{"ctrl-state", "motoron"}}).status ==
          204);
    CHECK(served.post(kOld, "/rw/rapid/execution?action=start", {{"execmode", "wrong"}}).status == 400);
    CHECK(served.post(kOld, "/rw/rapid/execution?action=start", {{"execmode", "continue"}, {"cycle", "once"}})
              .status == 204);
    REQUIRE(served.waitFor(kOld, "/rw/rapid/execution", "ctrlexecstate", "stopped"));
    CHECK(served.read(kOld, "/rw/rapid/execution", "cycle") == "once");
    CHECK(served.read(kNew, "/rw/rapid/tasks", "excstate") == "stopped");
    CHECK(served.post(kOld, "/rw/rapid/execution?action=resetpp").status == 204);
    REQUIRE(served.waitFor(kNew, "/rw/rapid/tasks/T_ROB1/pcp", "beginposition", "16,7"));
    CHECK(served
              .post(kOld, "/rw/rapid/tasks/T_ROB1/pcp?action=set-pp-routine",
                    {{"module", "Main1"}, {"routine", "work"}})
              .status == 204);
    REQUIRE(served.waitFor(kNew, "/rw/rapid/tasks/T_ROB1/pcp", "routinename", "work"));
    CHECK(served.read(kNew, "/rw/rapid/tasks/T_ROB1/pcp", "beginposition") == "22,7");
    CHECK(served
              .post(kOld, "/rw/rapid/tasks/T_ROB1/pcp?action=set-pp-cursor",
                    {{"module", "Main1"}, {"line", "18"}})
              .status == 204);
    REQUIRE(served.waitFor(kNew, "/rw/rapid/tasks/T_ROB1/pcp", "beginposition", "18,7"));
    CHECK(served.post(kOld, "/rw/rapid/execution?action=start", {{"execmode", "stepin"}}).status == 204);
    REQUIRE(served.waitFor(kNew, "/rw/rapid/tasks/T_ROB1/pcp", "beginposition", "22,7"));
}

TEST_CASE("Mastership: one table for both dialects (serve-contract 37, 38)", "[rws]") {
    ServedController served(kModules);
    REQUIRE(served.opened());
    const std::string speed = "/rw/panel/speedratio?action=setspeedratio";
    const auto set = [&](Dialect dialect, uint64_t session) {
        return served.post(dialect, speed, {{"speed-ratio", "50"}}, session);
    };
    CHECK(set(kOld, 1).status == 204);
    CHECK(set(kNew, 2).failure->code == ReturnCode::NoMastership);
    CHECK(set(kNew, 2).status == 403);
    CHECK(served.read(kNew, "/rw/mastership/edit", "mastership", "msh-resource") == "nomaster");
    CHECK(served.post(kNew, "/rw/mastership/edit/request", {}, 2).status == 204);
    CHECK(set(kNew, 2).status == 204);
    CHECK(served.read(kOld, "/rw/mastership/cfg", "mastership") == "remote");
    CHECK(served.read(kOld, "/rw/mastership/rapid", "mastership") == "remote");
    CHECK(served.read(kOld, "/rw/mastership/motion", "mastership") == "nomaster");
    CHECK(set(kOld, 1).failure->code == ReturnCode::HeldByOther);
    CHECK(served.post(kOld, "/rw/mastership/rapid?action=request", {}, 1).failure->code ==
          ReturnCode::HeldByOther);
    CHECK(served.post(kOld, "/rw/mastership?action=request", {}, 1).status == 403);
    served.onController([&] { served.services().sessionEnded(2); });
    CHECK(served.post(kOld, "/rw/mastership/rapid?action=request", {}, 1).status == 204);
    CHECK(served.post(kNew, "/rw/mastership/edit/request", {}, 2).status == 403);
    served.onController([&] { served.services().connectionClosed(1); }); // RWS 1.0: ends with the connection
    CHECK(served.post(kNew, "/rw/mastership/edit/request", {}, 2).status == 204);
    CHECK(served.post(kNew, "/rw/mastership/edit/release", {}, 2).status == 204);
    const std::string id = ServedController::spanOf(
        served.post(kNew, "/rw/mastership/edit/request-with-id", {}, 2), "mastership-id");
    served.onController([&] { served.services().sessionEnded(2); });
    CHECK(served.post(kNew, "/rw/mastership/edit/request", {}, 3).status == 403);
    CHECK(served.post(kNew, "/rw/mastership/edit/release-with-id", {{"mastershipid", "1"}}, 3).status == 400);
    CHECK(served.post(kNew, "/rw/mastership/edit/release-with-id", {{"mastershipid", id}}, 3).status == 204);
    CHECK(served.post(kNew, "/rw/mastership/edit/request", {}, 3).status == 204);
}

TEST_CASE("Manual mode: changes need the privilege (serve-contract 39)", "[rws]") {
    ServedController served(kModules);
    REQUIRE(served.opened());
    const auto write = [&] {
        return served.post(kOld, dataPath(kOld, "T_ROB1/count") + "?action=set", {{"value", "1"}}).status;
    };
    CHECK(served.post(kOld, "/rw/panel/opmode", {{"opmode", "man"}}).status == 204);
    CHECK(served.read(kOld, "/rw/panel/opmode", "opmode", "pnl-opmode") == "MANR");
    CHECK(served.read(kNew, "/rw/panel/ctrl-state", "ctrlstate") == "motoroff");
    CHECK(write() == 403);
    CHECK(served.post(kOld, "/users/rmmp", {{"privilege", "modify"}}).status == 202);
    CHECK(served.read(kOld, "/users/rmmp/poll", "status", "user-rmmp-poll") == "GRANTED");
    CHECK(served.read(kOld, "/users/rmmp", "privilege") == "modify");
    CHECK(write() == 204);
    CHECK(served.post(kOld, "/users/rmmp?action=cancel").status == 204);
    CHECK(write() == 403);
    CHECK(served.post(kOld, "/rw/panel/opmode", {{"opmode", "auto"}}).status == 204);
    CHECK(write() == 204);
}

TEST_CASE("Control stations of RobotWare 8 (serve-contract 40)", "[rws]") {
    ServedController served(kModules, false, 8);
    REQUIRE(served.opened());
    CHECK(served.get(kNew, "/rw/mastership").status == 410);
    CHECK(served.post(kNew, "/rw/mastership/edit/request").status == 410);
    const auto write = [&](uint64_t session) {
        return served.post(kNew, dataPath(kNew, "T_ROB1/count"), {{"value", "1"}}, session);
    };
    const std::string request = "/rw/controlstation/writeaccess/request";
    const auto registered = [&](uint64_t session, const std::string& id) {
        return served
            .post(kNew, "/rw/controlstation/register/remote",
                  {{"control-station-name", "PC"}, {"control-station-id", id}, {"pincode", "1234"}}, session)
            .status;
    };
    CHECK(write(1).failure->code == ReturnCode::StationUnknown);
    CHECK(served.post(kNew, request).status == 403);
    CHECK(registered(1, "1234") == 400);
    CHECK(registered(1, "{01234567-89ab-cdef-0123-456789abcdef}") == 204);
    CHECK(write(1).failure->code == ReturnCode::NoWriteAccess);
    CHECK(served.post(kNew, request).status == 204);
    CHECK(write(1).status == 204);
    CHECK(registered(2, "{01234567-89ab-cdef-0123-456789abcde0}") == 204);
    CHECK(served.post(kNew, request, {}, 2).status == 403);
    CHECK(served.read(kNew, "/rw/controlstation/writeaccess/status", "held-by-control-station-name") == "PC");
    CHECK(served.post(kNew, "/rw/controlstation/writeaccess/release").status == 204);
    CHECK(served.post(kNew, request, {}, 2).status == 204);
}

TEST_CASE("Control stations do not exist below RobotWare 8 (serve-contract 40)", "[rws]") {
    ServedController served(kModules);
    REQUIRE(served.opened());
    CHECK(served.get(kNew, "/rw/controlstation/writeaccess/status").status == 404);
}

TEST_CASE("Dialogs are read and answered (serve-contract 22, 31)", "[rws]") {
    ServedController served({{"Main1.mod", R"(MODULE Main1
   PERS num answer := 0;
   PERS num entered := 0;
   PROC main()
      VAR btnres button;
      UIMsgBox "Continue?" \Buttons:=btnYesNo \Result:=button;
      answer := button;
      entered := UINumEntry(\Header:="Number" \Message:="Enter it");
      Stop;
   ENDPROC
ENDMODULE
)"}},
                            true);
    REQUIRE(served.opened());
    const std::string active = "/rw/rapid/uiinstr/active";
    REQUIRE(served.waitFor(kOld, active, "instr", "UIMsgBox"));
    CHECK(served.read(kOld, active, "msg") == "Continue?");
    CHECK(served.read(kNew, active, "event") == "SEND");
    std::string stack = served.read(kOld, active, "stack");
    CHECK(stack.starts_with("RAPID/T_ROB1/%$"));
    CHECK(served.post(kOld, active + "/param/" + stack + "/Result", {{"value", "3"}}).status == 400);
    CHECK(served.post(kOld, active + "/param/" + stack + "/Result", {{"value", "1"}}).status == 204);
    REQUIRE(served.waitFor(kOld, active, "instr", "UINumEntry"));
    CHECK(served.read(kOld, dataPath(kOld, "T_ROB1/answer"), "value") == "6"); // resYes
    stack = served.read(kOld, active, "stack");
    CHECK(served.post(kNew, active + "/param/" + stack + "/Result", {{"value", "text"}}).status == 400);
    CHECK(served.post(kNew, active + "/param/" + stack + "/Result", {{"value", "12.5"}}).status == 204);
    REQUIRE(served.waitFor(kOld, "/rw/rapid/execution", "ctrlexecstate", "stopped"));
    CHECK(served.read(kOld, dataPath(kOld, "T_ROB1/entered"), "value") == "12.5");
    CHECK(served.get(kOld, active).status == 404);
}

TEST_CASE("Queues carry messages between clients and tasks (controller.md 2.3)", "[rws]") {
    ServedController served({{"Main1.mod", R"(MODULE Main1
   PROC main()
      VAR rmqslot slot;
      VAR rmqmessage message;
      VAR rmqheader header;
      VAR num value;
      RMQReadWait message \TimeOut:=60;
      RMQGetMsgData message, value;
      RMQFindSlot slot, "PC";
      value := value + 1;
      RMQSendMessage slot, value;
      Stop;
   ENDPROC
ENDMODULE
)"}},
                            true);
    REQUIRE(served.opened());
    const FieldList create{
        {"dipc-queue-name", "PC"}, {"dipc-queue-size", "4440"}, {"dipc-max-msg-size", "444"}};
    CHECK(served.post(kOld, "/rw/dipc?action=dipc-create", create).status == 201);
    CHECK(served.post(kOld, "/rw/dipc?action=dipc-create", create).failure->code == ReturnCode::BadParameter);
    const FieldList message{{"dipc-src-queue-name", "PC"},
                            {"dipc-cmd", "111"},
                            {"dipc-userdef", "1"},
                            {"dipc-msgtype", "1"},
                            {"dipc-data", "num;41"}};
    CHECK(served.post(kOld, "/rw/dipc/RMQ_T_ROB1?action=dipc-send", message).status == 204);
    const Reply reply = served.get(kOld, "/rw/dipc/PC?action=dipc-read&timeout=10");
    CHECK(ServedController::spanOf(reply, "dipc-data", "dipc-read-li") == "num;42");
    CHECK(ServedController::spanOf(reply, "queue-name") == "RMQ_T_ROB1");
    CHECK(served.get(kNew, "/rw/dipc/PC").document->entries.empty());
    CHECK(served.post(kOld, "/rw/dipc/None?action=dipc-send", message).status == 404);
    CHECK(served.call(kOld, Method::Delete, "/rw/dipc/PC").status == 204);
    CHECK(served.get(kOld, "/rw/dipc/PC").status == 404);
}

TEST_CASE("Users, grants and login (serve-contract 8, 22)", "[rws]") {
    ServedController served(kModules);
    REQUIRE(served.opened());
    CHECK(served
              .post(kOld, "/users",
                    {{"username", "me"}, {"application", "app"}, {"location", "here"}, {"ulocale", "local"}})
              .status == 201);
    CHECK(served.read(kNew, "/users/login-info", "user-alias", "user-login-info") == "me");
    CHECK(served.read(kOld, "/users/grants", "grantname", "user-grant") == "UAS_FULL_ACCESS");
    CHECK(served.read(kNew, "/uas/grants", "grant-name", "grant-info") == "UAS_FULL_ACCESS");
    CHECK(served.read(kNew, "/uas/user/grants", "grantname", "uas-grant") == "UAS_FULL_ACCESS");
    CHECK(served.read(kNew, "/users/grant-exists?grant=UAS_BACKUP", "status") == "true");
}

TEST_CASE("Activation of tasks (controller.md 2.3)", "[rws]") {
    ServedController served(kModules);
    REQUIRE(served.opened());
    CHECK(served.post(kOld, "/rw/rapid/tasks/T_ROB1?action=deactivate").status == 204);
    CHECK(served.read(kOld, "/rw/rapid/tasks", "active") == "Off");
    CHECK(served.read(kNew, "/rw/rapid/taskselection", "state", "rap-taskselection") == "OFF");
    CHECK(served.post(kNew, "/rw/rapid/tasks/activate", {{"task", "T_ROB1"}}).status == 403);
    CHECK(served.post(kNew, "/rw/rapid/tasks/activate?mastership=implicit", {{"task", "T_ROB1"}}).status ==
          204);
    CHECK(served.read(kOld, "/rw/rapid/tasks", "active") == "On");
    CHECK(served.post(kOld, "/rw/rapid/tasks/None?action=activate").status == 404);
}

TEST_CASE("The stops of the panel and the lock of the mode (controller.md 2.3)", "[rws]") {
    ServedController served(kModules);
    REQUIRE(served.opened());
    const auto state = [&] {
        return served.read(kNew, "/rw/panel/ctrl-state", "ctrlstate", "pnl-ctrlstate");
    };
    const auto motors = [&](const char* to) {
        return served.post(kNew, "/rw/panel/ctrl-state", {{"ctrl-state", to}}).status;
    };
    CHECK(motors("motoron") == 204);
    CHECK(state() == "motoron");
    CHECK(served.post(kNew, "/rw/panel/emergency-stop", {{"state", "off"}}).status == 204);
    CHECK(state() == "emergencystop");
    CHECK(motors("motoron") == 403);
    CHECK(served.post(kNew, "/rw/panel/emergency-stop", {{"state", "on"}}).status == 204);
    CHECK(state() == "motoroff");
    CHECK(served.post(kNew, "/rw/panel/general-stop", {{"state", "off"}}).status == 204);
    CHECK(state() == "guardstop");
    CHECK(served.post(kNew, "/rw/panel/general-stop", {{"state", "on"}}).status == 204);
    CHECK(motors("motoron") == 204);
    CHECK(motors("on") == 400);
    CHECK(served.post(kNew, "/rw/panel/opmode/lock", {{"pin", "1234"}, {"permanent", "false"}}).status ==
          204);
    CHECK(served.read(kNew, "/rw/panel/opmode/lock-state", "lockstate") == "locked");
    CHECK(served.post(kNew, "/rw/panel/opmode", {{"opmode", "man"}}).status == 403);
    CHECK(served.post(kNew, "/rw/panel/opmode/unlock").status == 204);
    CHECK(served.post(kNew, "/rw/panel/opmode", {{"opmode", "MAN"}}).status == 400);
    CHECK(served.post(kNew, "/rw/panel/opmode", {{"opmode", "manf"}}).status == 204);
    CHECK(served.read(kNew, "/rw/panel/opmode", "opmode") == "MANF");
}
