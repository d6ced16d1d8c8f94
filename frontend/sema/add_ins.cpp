#include "frontend/sema/add_ins.h"

#include <algorithm>
#include <iterator>
#include <unordered_map>
#include <utility>
#include <vector>

namespace rapid::sema {

namespace {

constexpr std::string_view kOtherRelease = "another release of RobotWare";
constexpr std::string_view kRobotWare = "RobotWare itself, in a module that backups do not hold";

struct AddInNames {
    std::string_view where;
    std::string_view names;      ///< lower case, separated by blanks; '*' for any end
    std::string_view types = {}; ///< data types that as names of data would rather be mistakes
};
/// Of the options only what the library does not declare.
constexpr AddInNames kAddIns[] = {
    {"the add-in RobotWare Arc",
     "recoverymenu recoverymenuwr recoveryposset recoveryposreset setwrprocname mpsavepath mploadpath "
     "mpreadinpath mpoffseaxonpath arcrepl arcadaptlstart arcadaptl arcadaptc arcadaptlend "
     "arcadaptcend arccalclstart arccalcl arccalcc arccalclend arccalccend arcadaptrepl multidata "
     "adaptdata refdata naeresumetype resume_kill resume_skip_* starctopoint aw_*",
     "advseamdata flystartdata"},
    {"the add-in Conveyor Tracking",
     "useaccprofile recordprofile waitandrecprof storeprofile loadprofile activateprofile "
     "deactprofile cnvgeninstr cnvsync usereachabletargets getmaxusagetime resetmaxusagetime "
     "cnvpredictreach err_moc_cnv_*",
     "cnvcmd"},
    {"the add-in RobotWare Paint",
     "consolewrite ipssetparam pntproduserlog setbrush setbrushfac paintlsig paintldo paintc "
     "indexlookup ipscommand ipsgetparam paintcommand pntqueueextraget pntqueueextraset pntqueuepeek "
     "brushdata err_ips* pw_equip_err paint_err"},
    {"the add-in RobotWare Spot",
     "recalctcp "
     "swsetintspotdata swsetintforcedata swsetintgundata swsetintsimdata swgetcalibdata "
     "swgetfixtipdata measurewearl swgetcurrtargetname "
     "swgetcurrspotname nutl nutj smeqdata",
     "smeqtype"},
    {"the add-in Tool Changing",
     "tcclosecover tcdropofftool tclocktool tcopencover tcpickuptool tcunlocktool tc_err_*",
     "standno toolinfo toolno"},
    {"the add-in RobotWare Dispense", "settmsignal syncwwobj getsignal getsignaldnum equipdata err_glueflow"},
    {"the add-in Continuous Application Platform",
     "capaptrsetup capaptrsetupai capaptrsetupao capaptrsetuppers capcondsetdo capequidist "
     "capnoprocess caprefresh capsetstopmode capweavesync icap initsuperv ipathpos removesuperv "
     "setupsuperv capc capl caplatrsetup capgetfailsigs capdata captrackdata capweavedata "
     "capspeeddata cap_* start_pre pre_started end_pre pre_ended start_main main_started end_main "
     "main_ended main_motion stop_weavestart weavestart_regain motion_delay startspeed_time "
     "move_started new_instr at_point at_restartpoint at_errorpoint last_segment process_end_point "
     "path_end_point process_ended start_post1 post1_started end_post1 post1_ended start_post2 "
     "post2_started end_post2 post2_ended equidist fly_start fly_end last_instr_ended",
     "capaptrreferencedata caplatrackdata capevent capmvsttim capstopmode captestno flypointdata "
     "processtimes restartblkdata supervtimeouts supervtype weavestartdata proc_times sup_timeouts"},
    {"the add-in SoftMove",
     "cssact cssdeact cssdeactmovel cssforceoffsetact cssforceoffsetdeact cssoffsettune css_*", "cssframe"},
    {"the add-in BullsEye",
     "be_device be_scan be_tooldesign bechecktcp bedebugstate berefpointer besetuptoolj betcpextend "
     "beupdatetcp offstoolxyz offstoolpolar besuccess benooverwrite benonamematch benobedatamod bearrayfull "
     "betoolnotfound betoolnotset beinvalidsignal bealiasset berangelimfail berangesingfail berangetiltfail "
     "bescanplaneerr bescanradzero bebframe* bebeam* beheightsrcherr besrcherr* benumofscanserr "
     "bediazeroorless beslicecounterr begetnewtcpmax begettcpdelerr begetgantryerr berefposseterr "
     "bereftoolseterr berefbeamseterr berefreseterr besetupalready besetupfailed bestartchanged becheckerr "
     "beskipupdate bestrtningerr beallnotset bequikrefnotdef beconvergerr beinstfwderr beunknownerr"},
    {"the add-in Force Control (Machining FC, Assembly FC)",
     "fcact fccalib fccond* fcdeact fcpress* fcref* fcresetdampingtune fcresetlpfiltertune fcspdchg* "
     "fcsetdampingtune fcsetlpfiltertune fcsupv* fcgetforce fcgetprocessdata fcisforcemode fcloadid "
     "fc_* fcdirections fcframe fcforcevector fcspeedvector fcprocessdata fcboxvol fccylindervol fcspherevol "
     "fcdamping",
     "fccondstatus fclindir fcplane fcrotdir fcspdchgtunetype fcxyznum"},
    {"the add-in Discrete Application Platform",
     "daactproc dadeactallproc dadeactproc dadefextsig dadefprocdata dadefprocsig dadefuserdata "
     "dagetcurrdata dasetcurrdata dasetupappbehav dastartmanaction dagetappdescr dagetappindex "
     "dagetnumofprocs dagetnumofrob dagetprcdescr daprocml daprocmj dagetfsttimeevt dacheckmmsopt "
     "dagetmp dagetrobotname dagettaskname err_da_*",
     "dadescapp dadescprc daintdata"},
    {"the add-in Production Manager",
     "menudata partdata ee_event ee_* pmgr* gap_* execengine robathomepos op_no_robot op_service "
     "op_production ct_continuous ct_count_cycles ct_count_cyc_action ct_periodical"},
    {"the add-in RobotWare Machine Tending",
     "err_mt_* gsopen gsvacuumoff gsbackward gsclose gsvacuumon gsforward gsreset gasetandcheck gaset "
     "gacheck gacheckclose"},
    {"the add-in Optical Tracking", "optscandata opttrackdata optsearch_* ltapp__*"},
    {"the add-in HomePos-Running",
     "smovej smovejdo smovejgo smovejsync smovel smoveldo smovelgo smovelsync ssearchl striggj "
     "striggl scssdeactmovel hr_*"},
    {"the add-in SmarTac", "search_1d search_groove search_part pdispadd oframechange smtspeedstd"},
    {"the add-in SmartGripper (YuMi)",
     "hand_* eventlog g_init g_calibrate g_gripin g_gripout g_jogin g_jogout g_moveto g_stop g_getpos "
     "g_vacuumon* g_vacuumoff* g_blowon* g_blowoff* g_setforce g_setmaxspd g_getspd g_iscalibrated "
     "g_getpressure* g_getvac* err_hand_*"},
    {"the add-in PickMaster",
     "itmsrc itmsrctype itmtgt getitmtgt ackitmtgt nextitmtgttype qstartitmsrc qstopitmsrc "
     "flushitmsrc pick_type place_type pickplace_tune speed_tune resetitmsrc resetflowcount getflowcount "
     "getqueuelevel getqueuetoplevel itmsrcdata maxnosources noncnvwodata "
     "noncnvwobjname cnvname err_ppa_* ppadropwobj ppa_* waitforexeorder remoteipnode "
     "pickplacerunning pickplaceseq safestopexecuted incoordrout",
     "selectiondata sortdata"},
    {"the add-in PickMaster palletizing (Palletizing PowerPac)",
     "pm_* pmack* pmcalc* pmcompare* pmdo* pmerrorlog pmget* pmlast* pmload* pmproj* pmreset* pmsearch* "
     "pmset* pmstart* pmstop* pmwait*"},
    {"the add-in Machine Synchronization", "prx*"},
    {"the add-in Brake Check and SafeMove (service routines)", "brakecheck cyclicbrakecheck"},
    {"the add-in Lincoln ArcLink XT", "lincweldmodedata"},
    {"the add-in of the Servo-Robot seam finder", "asfmu_*"},
    {"the modules of the Volkswagen standard",
     "moveabs_* movecirc_* movelin_* moveptp_* searchcirc_* searchlin_*"},
    {kRobotWare, "linked_m linked_m_exe"},
    {kOtherRelease,
     "ditheract ditherdeact ioctrlaxis_* movepnp err_csv_index err_mod_notloaded err_whl_search sys_err_*",
     "triggflag tasksatstart searchdata stopmovestartmove_mem"},
};

/// The words of all lists of one kind, with the position of their add-in.
class WordIndex {
  public:
    static constexpr size_t kNone = std::size(kAddIns);

    void add(std::string_view list, size_t addIn) {
        while (!list.empty()) {
            const size_t end = std::min(list.find(' '), list.size());
            std::string_view word = list.substr(0, end);
            list.remove_prefix(std::min(end + 1, list.size()));
            if (word.ends_with('*')) {
                word.remove_suffix(1);
                beginnings_.emplace_back(word, addIn);
            }
            words_.emplace(word, addIn);
        }
    }

    /// The first add-in whose list has the name, or unless `whole` a beginning of it.
    size_t find(std::string_view folded, bool whole) const {
        const auto found = words_.find(folded);
        size_t first = found == words_.end() ? kNone : found->second;
        if (whole) return first;
        for (const auto& [word, addIn] : beginnings_)
            if (addIn < first && folded.starts_with(word)) first = addIn;
        return first;
    }

  private:
    std::unordered_map<std::string_view, size_t> words_;
    std::vector<std::pair<std::string_view, size_t>> beginnings_;
};

WordIndex indexOf(std::string_view AddInNames::* list) {
    WordIndex index;
    for (size_t i = 0; i < std::size(kAddIns); ++i)
        index.add(kAddIns[i].*list, i);
    return index;
}

} // namespace

std::string_view addInOf(std::string_view folded, bool type, bool whole) {
    static const WordIndex names = indexOf(&AddInNames::names), types = indexOf(&AddInNames::types);
    size_t first = names.find(folded, whole);
    if (type) first = std::min(first, types.find(folded, whole));
    return first == WordIndex::kNone ? std::string_view() : kAddIns[first].where;
}

} // namespace rapid::sema
