#include "tools/lsp/configuration_words.h"

#include "config/text_util.h"

#include <algorithm>

namespace lsp {

namespace {

constexpr AttributeWord kSignal[] = {
    {"Name", "", "Name of the signal, as programs use it", ""},
    {"SignalType", "DI DO AI AO GI GO", "Digital, analog or group; input or output", ""},
    {"Device", "", "The device that has it; without one it is virtual", ""},
    {"Unit", "", "RobotWare 5: the unit that has it", ""},
    {"DeviceMap", "", "Its bits on the device: 7, 0-15, or a list", ""},
    {"UnitMap", "", "RobotWare 5: its bits on the unit", ""},
    {"Label", "", "A remark for people", ""},
    {"SignalLabel", "", "RobotWare 5: a remark for people", ""},
    {"Category", "", "A group for people; 'safety' hides it", ""},
    {"Access", "Default ReadOnly All", "Who may write it: a level of EIO_ACCESS", "EIO_ACCESS"},
    {"Default", "", "Value at start", ""},
    {"DefValue", "", "RobotWare 5: value at start", ""},
    {"EncType", "TWO_COMP UNSIGNED", "How an analog value lies in its bits", ""},
    {"MaxLog", "", "Logical value at MaxPhys", ""},
    {"MinLog", "", "Logical value at MinPhys", ""},
    {"MaxPhys", "", "Physical value at MaxBitVal", ""},
    {"MinPhys", "", "Physical value at MinBitVal", ""},
    {"MaxBitVal", "", "Largest value of the bits", ""},
    {"MinBitVal", "", "Smallest value of the bits", ""},
    {"MaxPhysLimit", "", "Upper limit of the physical value", ""},
    {"MinPhysLimit", "", "Lower limit of the physical value", ""},
    {"FiltPas", "", "Filter of a falling edge, in ms", ""},
    {"FiltAct", "", "Filter of a rising edge, in ms", ""},
    {"Invert", "", "The bits are inverted", ""},
    {"SafeLevel", "DefaultSafeLevel SafetySafeLevel", "What happens at start, stop and loss of the device",
     ""},
};
constexpr AttributeWord kCross[] = {
    {"Name", "", "Name of the cross connection", ""},
    {"Res", "", "The signal that gets the result", "EIO_SIGNAL"},
    {"Act1", "", "First operand", "EIO_SIGNAL"},
    {"Act1_invert", "", "The first operand is inverted", ""},
    {"Oper1", "AND OR", "Between the first and the second operand", ""},
    {"Act2", "", "Second operand", "EIO_SIGNAL"},
    {"Act2_invert", "", "The second operand is inverted", ""},
    {"Oper2", "AND OR", "Between the second and the third operand", ""},
    {"Act3", "", "Third operand", "EIO_SIGNAL"},
    {"Act3_invert", "", "The third operand is inverted", ""},
    {"Oper3", "AND OR", "Between the third and the fourth operand", ""},
    {"Act4", "", "Fourth operand", "EIO_SIGNAL"},
    {"Act4_invert", "", "The fourth operand is inverted", ""},
    {"Oper4", "AND OR", "Between the fourth and the fifth operand", ""},
    {"Act5", "", "Fifth operand", "EIO_SIGNAL"},
    {"Act5_invert", "", "The fifth operand is inverted", ""},
};
constexpr AttributeWord kAccess[] = {
    {"Name", "", "Name of the access level", ""},
    {"Rapid", "", "Programs may write", ""},
    {"LocalManual", "", "The pendant may write in manual mode", ""},
    {"LocalAuto", "", "The pendant may write in automatic mode", ""},
    {"RemoteManual", "", "Other computers may write in manual mode", ""},
    {"RemoteAuto", "", "Other computers may write in automatic mode", ""},
};
constexpr AttributeWord kSystemInput[] = {
    {"Signal", "", "The digital input that starts the action", "EIO_SIGNAL"},
    {"Action",
     "Backup EnableEnergySaving Interrupt LimitSpeed Load LoadStart MotorOff MotorOn MotorOnStart PPtoMain "
     "QuickStop ResetEstop ResetError SetSpeedOverride SimMode SoftStop Start StartMain Stop StopEndCycle "
     "StopEndInstr SystemRestart WriteAccess",
     "What happens when it is set", ""},
    {"Arg1", "CONT CYCLE", "Depends on the action: mode of the start, routine of an interrupt", "routine"},
    {"Arg2", "", "Depends on the action: the task", "CAB_TASKS"},
    {"Arg3", "", "Depends on the action", ""},
    {"Arg4", "", "Depends on the action", ""},
    {"Arg5", "", "Depends on the action", ""},
    {"Arg6", "", "LimitSpeed: the mechanical unit", ""},
};
constexpr AttributeWord kSystemOutput[] = {
    {"Status",
     "AbsAccActive AutoOn BackupError BackupInProgress CPUFan CycleOn EmergencyStop EmStop Error "
     "EnergySaving "
     "LimitSpeed MechUnitActive MechUnitNotMoving MotionSupTrigg MotorsOff MotorsOffState MotorsOn "
     "MotorsOnState MotOnState MotSupOn MotSupTrigg PathReturnRegion PowerFailError PPMoved ProductionError "
     "RobotNotOnPath RunchnOk SimMode SpeedOverride SystemBusy TaskExecuting TCPSpeed TCPSpeedRef "
     "WriteAccess",
     "The state that it shows", ""},
    {"Signal", "", "The output that shows it", "EIO_SIGNAL"},
    {"Arg1", "", "Depends on the state: the mechanical unit", ""},
    {"Arg2", "", "Depends on the state: the task", "CAB_TASKS"},
};
constexpr AttributeWord kNetworkDevice[] = {
    {"Name", "", "Name of the device", ""},
    {"Network", "", "The industrial network it belongs to", "INDUSTRIAL_NETWORK"},
    {"VendorName", "", "Who made it", ""},
    {"ProductName", "", "What it is", ""},
    {"Label", "", "A remark for people", ""},
    {"Address", "", "Its address on the network", ""},
    {"Simulated", "", "It is simulated", ""},
    {"OutputSize", "", "Bytes of outputs", ""},
    {"InputSize", "", "Bytes of inputs", ""},
};
constexpr AttributeWord kNetwork[] = {
    {"Name", "", "Name of the network", ""},
    {"Label", "", "A remark for people", ""},
    {"Connection", "", "The port of the controller", ""},
    {"Address", "", "The controller's address", ""},
    {"Simulated", "", "It is simulated", ""},
};
constexpr AttributeWord kTasks[] = {
    {"Name", "", "Name of the task", ""},
    {"Type", "NORMAL STATIC SEMISTATIC", "NORMAL starts and stops with the program; without it SEMISTATIC",
     ""},
    {"Entry", "", "The routine that it begins with; without it main", "routine"},
    {"MotionTask", "", "It moves a robot", ""},
    {"Task_in_forground", "", "The task that runs before it", "CAB_TASKS"},
    {"TrustLevel", "None SysFail SysHalt SysStop", "What its end does to the system", ""},
    {"BindRef", "", "References are bound when it is loaded", ""},
    {"RmqType", "Internal Remote", "Who may send to its queue", ""},
    {"RmqMaxMsgSize", "", "Largest message of its queue, in bytes", ""},
    {"RmqMaxNoOfMsg", "", "Most messages in its queue", ""},
    {"UseMechanicalUnitGroup", "", "The units it moves", "MECHANICAL_UNIT_GROUP"},
};
constexpr AttributeWord kModules[] = {
    {"File", "", "Where it lies: HOME:/x.sys", "file"},
    {"ModName", "", "Name of the module, if it is not that of the file", ""},
    {"Task", "", "The task that loads it", "CAB_TASKS"},
    {"AllTask", "", "All tasks load it", ""},
    {"AllMotionTask", "", "All motion tasks load it", ""},
    {"Shared", "", "One copy for all tasks", ""},
    {"Install", "", "It is installed and cannot be changed", ""},
    {"Hidden", "", "It is not shown", ""},
};
constexpr AttributeWord kHooks[] = {
    {"Routine", "", "The routine that the event starts", "routine"},
    {"Shelf", "POWER_ON START RESTART STEP STOP QSTOP RESET", "The event", ""},
    {"Task", "", "The task that executes it", "CAB_TASKS"},
    {"AllTask", "", "All tasks execute it", ""},
    {"AllMotionTask", "", "All motion tasks execute it", ""},
    {"SeqNo", "", "Its place among the routines of the event", ""},
};
constexpr AttributeWord kMisc[] = {
    {"Name", "NoOfRetry SimulateMenu ModalPayLoadMode RapidLogging StepOutNoStepin", "Name of the parameter",
     ""},
    {"Value", "", "Its value", ""},
};
constexpr AttributeWord kGroup[] = {
    {"Name", "", "Name of the group", ""},          {"Robot", "", "Its robot", ""},
    {"MechanicalUnit_1", "", "Its first unit", ""}, {"MechanicalUnit_2", "", "Its second unit", ""},
    {"MechanicalUnit_3", "", "Its third unit", ""}, {"MechanicalUnit_4", "", "Its fourth unit", ""},
    {"MechanicalUnit_5", "", "Its fifth unit", ""}, {"MechanicalUnit_6", "", "Its sixth unit", ""},
};
constexpr AttributeWord kTransmission[] = {
    {"Name", "", "Name of the channel", ""},
    {"Type", "TCP/IP UDPUC", "Its protocol", ""},
    {"PhyChannel", "", "The port of the controller", "COM_PHY_CHANNEL"},
    {"RemoteAdress", "", "Address of the other side (the spelling is that of the format)", ""},
    {"RemotePortNumber", "", "Port of the other side", ""},
    {"LocalPortNumber", "", "Port of the controller", ""},
};
constexpr AttributeWord kRobot[] = {
    {"name", "", "Name of the robot", ""},
    {"use_robot_type", "", "Its model; 'rapidc robots' lists those that can be simulated", ""},
    {"base_frame_pos_x", "", "Place of its base, in metres", ""},
    {"base_frame_pos_y", "", "Place of its base, in metres", ""},
    {"base_frame_pos_z", "", "Place of its base, in metres", ""},
    {"base_frame_orient_u0", "", "Orientation of its base", ""},
    {"base_frame_orient_u1", "", "Orientation of its base", ""},
    {"base_frame_orient_u2", "", "Orientation of its base", ""},
    {"base_frame_orient_u3", "", "Orientation of its base", ""},
};
constexpr AttributeWord kArm[] = {
    {"name", "", "Name of the arm", ""},
    {"upper_joint_bound", "", "Upper limit of the joint, in radians or metres", ""},
    {"lower_joint_bound", "", "Lower limit of the joint, in radians or metres", ""},
};
constexpr AttributeWord kUnit[] = {
    {"name", "", "Name of the mechanical unit", ""},
    {"use_robot", "", "Its robot", "ROBOT"},
    {"use_single_0", "", "Its first single axis", "SINGLE"},
    {"activate_at_start_up", "", "It is active after a start", ""},
};

constexpr TypeWord kTypes[] = {
    {"EIO", "EIO_SIGNAL", "Signals", kSignal},
    {"EIO", "EIO_CROSS", "Cross connections: a signal from other signals", kCross},
    {"EIO", "EIO_ACCESS", "Access levels of signals", kAccess},
    {"EIO", "SYSSIG_IN", "System inputs: signals that control the controller", kSystemInput},
    {"EIO", "SYSSIG_OUT", "System outputs: signals that show its state", kSystemOutput},
    {"EIO", "INDUSTRIAL_NETWORK", "Industrial networks", kNetwork},
    {"EIO", "DEVICENET_DEVICE", "Devices on DeviceNet", kNetworkDevice},
    {"EIO", "PROFINET_DEVICE", "Devices on PROFINET", kNetworkDevice},
    {"EIO", "ETHERNETIP_DEVICE", "Devices on EtherNet/IP", kNetworkDevice},
    {"SYS", "CAB_TASKS", "Tasks", kTasks},
    {"SYS", "CAB_TASK_MODULES", "Modules that tasks load at start", kModules},
    {"SYS", "CAB_EXEC_HOOKS", "Event routines", kHooks},
    {"SYS", "SYS_MISC", "Parameters of execution", kMisc},
    {"SYS", "MECHANICAL_UNIT_GROUP", "Groups of mechanical units", kGroup},
    {"SIO", "COM_TRP", "Transmission protocols", kTransmission},
    {"MOC", "ROBOT", "Robots", kRobot},
    {"MOC", "ARM", "Arms: limits of joints", kArm},
    {"MOC", "MECHANICAL_UNIT", "Mechanical units", kUnit},
};

} // namespace

std::span<const TypeWord> configurationTypes() {
    return kTypes;
}

const TypeWord* findType(std::string_view name) {
    const auto found = std::find_if(std::begin(kTypes), std::end(kTypes), [&](const TypeWord& type) {
        return rapid::config::sameName(type.name, name);
    });
    return found == std::end(kTypes) ? nullptr : &*found;
}

const AttributeWord* findAttribute(const TypeWord& type, std::string_view name) {
    const auto found =
        std::find_if(type.attributes.begin(), type.attributes.end(),
                     [&](const AttributeWord& a) { return rapid::config::sameName(a.name, name); });
    return found == type.attributes.end() ? nullptr : &*found;
}

} // namespace lsp
