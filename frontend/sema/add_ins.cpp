#include "frontend/sema/add_ins.h"

#include <algorithm>

namespace rapid::sema {

namespace {

struct AddInNames {
    std::string_view addIn;
    std::string_view names; ///< lower case, separated by blanks; '*' for any end
};
/// Of the options only what the library does not declare.
constexpr AddInNames kAddIns[] = {
    {"RobotWare Arc",
     "recoverymenu recoverymenuwr recoveryposset recoveryposreset setwrprocname mpsavepath mploadpath "
     "mpreadinpath mpoffseaxonpath arcrepl arcadaptlstart arcadaptl arcadaptc arcadaptlend "
     "arcadaptcend arccalclstart arccalcl arccalcc arccalclend arccalccend arcadaptrepl multidata "
     "adaptdata refdata naeresumetype resume_kill resume_skip_* starctopoint"},
    {"Conveyor Tracking",
     "useaccprofile recordprofile waitandrecprof storeprofile loadprofile activateprofile "
     "deactprofile cnvgeninstr cnvsync usereachabletargets getmaxusagetime resetmaxusagetime "
     "cnvpredictreach"},
    {"RobotWare Paint",
     "consolewrite ipssetparam pntproduserlog setbrush setbrushfac paintlsig paintldo paintc "
     "indexlookup ipscommand ipsgetparam paintcommand pntqueueextraget pntqueueextraset pntqueuepeek "
     "brushdata"},
    {"RobotWare Spot",
     "setforce calibrate recalctcp indgunmove indgunmovereset openhighlift closehighlift "
     "swsetintspotdata swsetintforcedata swsetintgundata swsetintsimdata swgetcalibdata "
     "swgetfixtipdata spotl spotj spotml spotmj calibl calibj measurewearl swgetcurrtargetname "
     "swgetcurrspotname nutl nutj gundata spotdata forcedata simdata smeqdata"},
    {"Tool Changing", "tcclosecover tcdropofftool tclocktool tcopencover tcpickuptool tcunlocktool"},
    {"RobotWare Dispense", "settmsignal syncwwobj displ dispc getsignal getsignaldnum beaddata equipdata"},
    {"Continuous Application Platform",
     "capaptrsetup capaptrsetupai capaptrsetupao capaptrsetuppers capcondsetdo capequidist "
     "capnoprocess caprefresh capsetstopmode capweavesync icap initsuperv ipathpos removesuperv "
     "setupsuperv capc capl caplatrsetup cssdeactmovel capgetfailsigs capdata captrackdata "
     "capweavedata capspeeddata"},
    {"BullsEye",
     "be_device be_scan be_tooldesign bechecktcp bedebugstate berefpointer besetuptoolj betcpextend "
     "beupdatetcp offstoolxyz offstoolpolar"},
    {"Force Control (Machining FC, Assembly FC)",
     "fcact fccalib fccondforce fccondorient fccondpos fccondreorispeed fccondtcpspeed fccondtorque "
     "fccondwaitwhile fcdeact fcpress1lstart fcpressc fcpressend fcpressl fcrefcircle fcrefforce "
     "fcrefline fcrefmoveframe fcrefrot fcrefspiral fcrefsprforcecart fcrefstart fcrefstop "
     "fcreftorque fcresetdampingtune fcresetlpfiltertune fcspdchgact fcspdchgdeact fcspdchgtunset "
     "fcspdchgtunreset fcsetdampingtune fcsetlpfiltertune fcsupvforce fcsupvorient fcsupvpos "
     "fcsupvreorispeed fcsupvtcpspeed fcsupvtorque fcgetforce fcgetprocessdata fcisforcemode fcloadid "
     "fcframe fcforcevector fcspeedvector fcprocessdata fcboxvol fccylindervol fcspherevol fcdamping"},
    {"Discrete Application Platform",
     "daactproc dadeactallproc dadeactproc dadefextsig dadefprocdata dadefprocsig dadefuserdata "
     "dagetcurrdata dasetcurrdata dasetupappbehav dastartmanaction dagetappdescr dagetappindex "
     "dagetnumofprocs dagetnumofrob dagetprcdescr daprocml daprocmj dagetfsttimeevt dacheckmmsopt "
     "dagetmp dagetrobotname dagettaskname"},
    {"Production Manager", "menudata partdata ee_event ee_* pmgr* gap_* execengine robathomepos"},
    {"Optical Tracking", "optscandata opttrackdata optsearch_* ltapp__*"},
    {"HomePos-Running",
     "smovej smovejdo smovejgo smovejsync smovel smoveldo smovelgo smovelsync ssearchl striggj "
     "striggl scssdeactmovel hr_*"},
    {"SmartGripper (YuMi)",
     "hand_* g_init g_calibrate g_gripin g_gripout g_jogin g_jogout g_moveto g_stop g_getpos "
     "g_vacuumon* g_vacuumoff* g_blowon* g_blowoff* g_setforce g_setmaxspd g_getspd g_iscalibrated "
     "g_getpressure* g_getvac*"},
    {"PickMaster",
     "itmsrc itmsrctype itmtgt getitmtgt ackitmtgt nextitmtgttype qstartitmsrc qstopitmsrc "
     "flushitmsrc resetitmsrc resetflowcount getqueuelevel itmsrcdata maxnosources noncnvwodata "
     "noncnvwobjname ppadropwobj ppa_jump_move waitforexeorder remoteipnode pickplacerunning "
     "safestopexecuted incoordrout"},
    {"Lincoln ArcLink XT", "lincweldmodedata"},
};

} // namespace

std::string_view addInOf(std::string_view folded, bool whole) {
    for (const AddInNames& entry : kAddIns) {
        for (std::string_view rest = entry.names; !rest.empty();) {
            const size_t end = std::min(rest.find(' '), rest.size());
            std::string_view word = rest.substr(0, end);
            rest.remove_prefix(std::min(end + 1, rest.size()));
            const bool prefix = word.ends_with('*');
            if (prefix) word.remove_suffix(1);
            if (folded == word || (prefix && !whole && folded.starts_with(word))) return entry.addIn;
        }
    }
    return {};
}

} // namespace rapid::sema
