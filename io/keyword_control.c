/* *CONTROL_TERMINATION, _TIMESTEP, _HOURGLASS, _ENERGY, _ACCURACY, _BULK_VISCOSITY, _SHELL, _OUTPUT. */
#include "io/keyword_table.h"

#define AT(member) offsetof(ControlDefinitions, member)
static const FieldSpec termination_fields[] = {
    CARD_REAL("ENDTIM", termination.endtim, USED, TIME),
    CARD_INT("ENDCYC", termination.endcyc, USED, NONE),
    CARD_REAL("DTMIN", termination.dtmin, USED, NONE),
    CARD_REAL("ENDENG", termination.endeng, LISTED, NONE),
    CARD_REAL_OR("ENDMAS", termination.endmas, 1e8, LISTED, NONE),
    CARD_REAL("NOSOL", termination.nosol, LISTED, NONE),
};
static const FieldSpec timestep1_fields[] = {
    CARD_REAL("DTINIT", timestep.dtinit, USED, TIME), CARD_REAL_OR("TSSFAC", timestep.tssfac, 0.9, USED, NONE),
    CARD_INT("ISDO", timestep.isdo, LISTED, NONE),    CARD_REAL("TSLIMT", timestep.tslimt, LISTED, TIME),
    CARD_REAL("DT2MS", timestep.dt2ms, USED, TIME),   CARD_INT("LCTM", timestep.lctm, USED, ID_FUNCTION),
    CARD_INT("ERODE", timestep.erode, LISTED, NONE),  CARD_INT("MS1ST", timestep.ms1st, LISTED, NONE),
};
static const FieldSpec timestep2_fields[] = {
    CARD_REAL("DT2MSF", timestep.dt2msf, REFUSED, NONE),
    CARD_INT("DT2MSLC", timestep.dt2mslc, REFUSED, ID_FUNCTION),
    CARD_INT("IMSCL", timestep.imscl, REFUSED, NONE),
    CARD_GAP,
    CARD_GAP,
    CARD_INT("RMSCL", timestep.rmscl, LISTED, NONE),
    CARD_REAL("EMSCL", timestep.emscl, REFUSED, NONE),
    CARD_INT("IHDO", timestep.ihdo, LISTED, NONE),
};
static const FieldSpec hourglass_fields[] = {
    CARD_INT("IHQ", hourglass.ihq, LISTED, NONE),
    CARD_REAL_OR("QH", hourglass.qh, 0.1, USED, NONE),
};
static const FieldSpec energy_fields[] = {
    CARD_INT_OR("HGEN", energy.hgen, 1, LISTED, NONE),     CARD_INT_OR("RWEN", energy.rwen, 2, LISTED, NONE),
    CARD_INT_OR("SLNTEN", energy.slnten, 1, LISTED, NONE), CARD_INT_OR("RYLEN", energy.rylen, 1, LISTED, NONE),
    CARD_INT_OR("IRGEN", energy.irgen, 2, LISTED, NONE),   CARD_INT_OR("MATEN", energy.maten, 1, LISTED, NONE),
    CARD_INT_OR("DRLEN", energy.drlen, 1, LISTED, NONE),   CARD_INT_OR("DISEN", energy.disen, 1, LISTED, NONE),
};
static const FieldSpec accuracy_fields[] = {
    CARD_INT("OSU", accuracy.osu, LISTED, NONE),         CARD_INT_OR("INN", accuracy.inn, 1, LISTED, NONE),
    CARD_INT("PIDOSU", accuracy.pidosu, LISTED, ID_SET), CARD_INT("IACC", accuracy.iacc, LISTED, NONE),
    CARD_REAL("EXACC", accuracy.exacc, LISTED, NONE),
};
static const FieldSpec viscosity_fields[] = {
    CARD_REAL_OR("Q1", bulk_viscosity.q1, 1.5, LISTED, NONE),
    CARD_REAL_OR("Q2", bulk_viscosity.q2, 0.06, LISTED, NONE),
    CARD_INT_OR("TYPE", bulk_viscosity.type, 1, LISTED, NONE),
    CARD_INT("BTYPE", bulk_viscosity.btype, LISTED, NONE),
    CARD_INT("TSTYPE", bulk_viscosity.tstype, LISTED, NONE),
};
static const FieldSpec shell_fields[] = {
    CARD_REAL_OR("WRPANG", shell.wrpang, 20.0, LISTED, NONE), CARD_INT("ESORT", shell.esort, LISTED, NONE),
    CARD_INT_OR("IRNXX", shell.irnxx, -1, LISTED, NONE),      CARD_INT("ISTUPD", shell.istupd, LISTED, NONE),
    CARD_INT_OR("THEORY", shell.theory, 2, LISTED, NONE),     CARD_INT_OR("BWC", shell.bwc, 2, LISTED, NONE),
    CARD_INT_OR("MITER", shell.miter, 1, LISTED, NONE),       CARD_INT("PROJ", shell.proj, LISTED, NONE),
};
static const FieldSpec output_fields[] = {
    CARD_INT("NPOPT", output.npopt, LISTED, NONE),           CARD_INT("NEECHO", output.neecho, LISTED, NONE),
    CARD_INT("NREFUP", output.nrefup, LISTED, NONE),         CARD_INT("IACCOP", output.iaccop, LISTED, NONE),
    CARD_REAL("OPIFS", output.opifs, LISTED, TIME),          CARD_INT("IPNINT", output.ipnint, LISTED, NONE),
    CARD_INT_OR("IKEDIT", output.ikedit, 100, LISTED, NONE), CARD_INT_OR("IFLUSH", output.iflush, 5000, LISTED, NONE),
};
static const FieldSpec relaxation_fields[] = {
    CARD_INT_OR("NRCYCK", relaxation.nrcyck, 250, USED, NONE),
    CARD_REAL_OR("DRTOL", relaxation.drtol, 0.001, USED, NONE),
    CARD_REAL_OR("DRFCTR", relaxation.drfctr, 0.995, USED, NONE),
    CARD_REAL("DRTERM", relaxation.drterm, USED, TIME),
    CARD_REAL("TSSFDR", relaxation.tssfdr, USED, NONE),
    CARD_INT("IRELAL", relaxation.irelal, USED, NONE),
    CARD_REAL_OR("EDTTL", relaxation.edttl, 0.04, USED, NONE),
    CARD_INT("IDRFLG", relaxation.idrflg, USED, NONE),
};
#undef AT

/* Later cards, read only to list what they ask for. */
static const FieldSpec timestep3_fields[] = {CARD_GAP, UNUSED_INT("IGADO", 1, 0)};
static const FieldSpec shell2_fields[] = {
    UNUSED_REAL("ROTASCL", 0, 1.0), UNUSED_INT("INTGRD", 1, 0), UNUSED_INT("LAMSHT", 2, 0),
    UNUSED_INT("CSTYP6", 3, 1),     UNUSED_INT("THSHEL", 4, 0),
};
static const FieldSpec shell3_fields[] = {
    UNUSED_INT("PSSTUPD", 0, 0), UNUSED_INT("SIDT4TU", 1, 0), UNUSED_INT("CNTCO", 2, 0),    UNUSED_INT("ITSFLG", 3, 0),
    UNUSED_INT("IRQUAD", 4, 3),  UNUSED_REAL("W-MODE", 5, 0), UNUSED_REAL("STRETCH", 6, 0), UNUSED_INT("ICRQ", 7, 0),
};
static const FieldSpec shell4_fields[] = {
    UNUSED_INT("NFAIL1", 0, 0), UNUSED_INT("NFAIL4", 1, 0),  UNUSED_INT("PSNFAIL", 2, 0), UNUSED_INT("KEEPCS", 3, 0),
    UNUSED_INT("DELFR", 4, 0),  UNUSED_INT("DRCPSID", 5, 0), UNUSED_REAL("DRCPRM", 6, 1), UNUSED_INT("INTPERR", 7, 0),
};
static const FieldSpec shell5_fields[] = {
    UNUSED_INT("DRCMTH", 0, 0),
    UNUSED_INT("LISPSID", 1, 0),
    UNUSED_INT("NLOCDT", 2, 0),
};
static const FieldSpec output2_fields[] = {
    UNUSED_INT("IPRTF", 0, 0),  UNUSED_INT("IERODE", 1, 0), UNUSED_INT("TET10S8", 2, 2), UNUSED_INT("MSGMAX", 3, 50),
    UNUSED_INT("IPCURV", 4, 0), UNUSED_REAL("GMDT", 5, 0),  UNUSED_INT("IP1DBLT", 6, 0), UNUSED_INT("EOCS", 7, 0),
};
static const FieldSpec output3_fields[] = {
    UNUSED_INT("TOLEV", 0, 2),  UNUSED_INT("NEWLEG", 1, 0), UNUSED_INT("FRFREQ", 2, 1),   UNUSED_INT("MINFO", 3, 0),
    UNUSED_INT("SOLSIG", 4, 0), UNUSED_INT("MSGFLG", 5, 0), UNUSED_REAL("CDETOL", 6, 10), UNUSED_INT("IGEOM", 7, 1),
};
static const FieldSpec output4_fields[] = {
    UNUSED_INT("PHSCHNG", 0, 0), UNUSED_INT("DEMDEN", 1, 0), UNUSED_INT("ICRFILE", 2, 0), UNUSED_INT("SPC2BND", 3, 0),
    UNUSED_INT("PENOUT", 4, 0),  UNUSED_INT("SHLSIG", 5, 0), UNUSED_INT("HISNOUT", 6, 0), UNUSED_INT("ENGOUT", 7, 0),
};
static const FieldSpec output5_fields[] = {
    UNUSED_INT("INSF", 0, 0),   UNUSED_INT("ISOLSF", 1, 0), UNUSED_INT("IBSF", 2, 0),   UNUSED_INT("ISSF", 3, 0),
    UNUSED_INT("MLKBAG", 4, 0), UNUSED_INT("KINENG", 5, 0), UNUSED_INT("ISFCNT", 6, 1),
};

static const CardSpec termination_cards[] = {{"card 1", "", CARD_FIELDS(termination_fields)}};
static const CardSpec timestep_cards[] = {
    {"card 1", "", CARD_FIELDS(timestep1_fields)},
    {"card 2", "optional", CARD_FIELDS(timestep2_fields)},
    {"card 3", "optional", CARD_FIELDS(timestep3_fields)},
};
static const CardSpec hourglass_cards[] = {{"card 1", "", CARD_FIELDS(hourglass_fields)}};
static const CardSpec energy_cards[] = {{"card 1", "", CARD_FIELDS(energy_fields)}};
static const CardSpec accuracy_cards[] = {{"card 1", "", CARD_FIELDS(accuracy_fields)}};
static const CardSpec viscosity_cards[] = {{"card 1", "", CARD_FIELDS(viscosity_fields)}};
static const CardSpec shell_cards[] = {
    {"card 1", "", CARD_FIELDS(shell_fields)},          {"card 2", "optional", CARD_FIELDS(shell2_fields)},
    {"card 3", "optional", CARD_FIELDS(shell3_fields)}, {"card 4", "optional", CARD_FIELDS(shell4_fields)},
    {"card 5", "optional", CARD_FIELDS(shell5_fields)},
};
static const CardSpec relaxation_cards[] = {{"card 1", "", CARD_FIELDS(relaxation_fields)}};
static const CardSpec output_cards[] = {
    {"card 1", "", CARD_FIELDS(output_fields)},          {"card 2", "optional", CARD_FIELDS(output2_fields)},
    {"card 3", "optional", CARD_FIELDS(output3_fields)}, {"card 4", "optional", CARD_FIELDS(output4_fields)},
    {"card 5", "optional", CARD_FIELDS(output5_fields)},
};

/* Reads card 1 into the control record and the later, optional cards into used of it or into nothing. A keyword given
 * twice is warned of: the last one counts. */
static void read_control(KeywordRead *read, bool *given, Source *source, int stored_cards)
{
    UnusedCard unused;
    if (*given)
        keyword_warning(read, read->cards->block->source,
                        "this keyword is given again; the one before (line %d) no longer "
                        "counts",
                        source->line);
    *given = true;
    ControlDefinitions *control = &read->definitions->control;
    int status = keyword_card(read, 0, control, true, source);
    for (int i = 1; i < read->spec->card_count && status == 0; i++) {
        void *record = i < stored_cards ? (void *)control : (void *)&unused;
        if (keyword_card(read, i, record, false, NULL) && card_left(read->cards)) status = -1;
    }
    if (status == 0) keyword_finish(read);
}

#define CONTROL_READER(member, stored)                                                                                 \
    static void read_##member(KeywordRead *read)                                                                       \
    {                                                                                                                  \
        ControlDefinitions *control = &read->definitions->control;                                                     \
        read_control(read, &control->member.given, &control->member.source, stored);                                   \
    }
CONTROL_READER(termination, 1)
CONTROL_READER(hourglass, 1)
CONTROL_READER(energy, 1)
CONTROL_READER(accuracy, 1)
CONTROL_READER(bulk_viscosity, 1)
CONTROL_READER(shell, 1)
CONTROL_READER(output, 1)

static void read_timestep(KeywordRead *read)
{
    ControlDefinitions *control = &read->definitions->control;
    read_control(read, &control->timestep.given, &control->timestep.source, 2);
    if (control->timestep.tssfac < 0.0)
        keyword_error(read, control->timestep.source,
                      "TSSFAC = %g names a curve, which billow " BILLOW_VERSION " does not read here; give a number",
                      control->timestep.tssfac);
}

/* Without IDRFLG the keyword only holds settings in store. */
static void read_relaxation(KeywordRead *read)
{
    ControlDefinitions *control = &read->definitions->control;
    read_control(read, &control->relaxation.given, &control->relaxation.source, 1);
    const Source source = control->relaxation.source;
    int flag = control->relaxation.idrflg;
    if (flag != 0 && flag != -999 && flag != 1 && flag != 5) {
        keyword_error(read, source,
                      "IDRFLG = %d is not in billow " BILLOW_VERSION
                      ": 1 relaxes by damped steps, 5 solves the static equilibrium at DRTERM, 0 or -999 does neither",
                      flag);
        return;
    }
    if (control->relaxation.nrcyck < 1)
        keyword_error(read, source, "NRCYCK = %d: the number of cycles between checks must be positive",
                      control->relaxation.nrcyck);
    if (!(control->relaxation.drtol > 0.0 && control->relaxation.drtol < 1.0))
        keyword_error(read, source, "DRTOL = %g must lie between 0 and 1", control->relaxation.drtol);
    if (!(control->relaxation.drfctr > 0.0 && control->relaxation.drfctr <= 1.0))
        keyword_error(read, source, "DRFCTR = %g must lie between 0 and 1", control->relaxation.drfctr);
    if (control->relaxation.irelal != 0 && control->relaxation.irelal != 1)
        keyword_error(read, source, "IRELAL = %d is neither 0 nor 1", control->relaxation.irelal);
    if (control->relaxation.drterm < 0.0 || control->relaxation.tssfdr < 0.0 || control->relaxation.edttl < 0.0)
        keyword_error(read, source, "DRTERM, TSSFDR and EDTTL must not be negative");
}

static const KeywordSpec specs[] = {
    {.name = "*CONTROL_TERMINATION",
     .cards = termination_cards,
     .card_count = 1,
     .read = read_termination,
     .remark = "DTMIN is a share of the first step, as in LS-DYNA."},
    {.name = "*CONTROL_TIMESTEP",
     .aliases = {"*CONTROL_TIME_STEP"},
     .cards = timestep_cards,
     .card_count = 3,
     .read = read_timestep,
     .remark =
         "The step is computed from the elements' largest eigenvalues, so ISDO has no say. DT2MS adds mass once, at "
         "the start."},
    {.name = "*CONTROL_HOURGLASS",
     .cards = hourglass_cards,
     .card_count = 1,
     .read = read_hourglass,
     .remark = "For one-point quadrilaterals."},
    {.name = "*CONTROL_ENERGY",
     .cards = energy_cards,
     .card_count = 1,
     .read = read_energy,
     .remark = "The energy ledger always has all terms."},
    {.name = "*CONTROL_ACCURACY",
     .cards = accuracy_cards,
     .card_count = 1,
     .read = read_accuracy,
     .remark = "Membrane kinematics are objective and independent of the node numbering without it."},
    {.name = "*CONTROL_BULK_VISCOSITY",
     .cards = viscosity_cards,
     .card_count = 1,
     .read = read_bulk_viscosity,
     .remark = "Membranes have no bulk viscosity."},
    {.name = "*CONTROL_SHELL",
     .cards = shell_cards,
     .card_count = 5,
     .read = read_shell,
     .remark = "For shells with bending; ELFORM must be given on the section."},
    {.name = "*CONTROL_DYNAMIC_RELAXATION",
     .cards = relaxation_cards,
     .card_count = 1,
     .read = read_relaxation,
     .remark =
         "Before the run: IDRFLG = 1 relaxes by damped explicit steps, IDRFLG = 5 solves the static equilibrium with "
         "the curves' values at DRTERM; 0 and -999 do neither, other values are refused. Loads by curves of SIDR = 1 "
         "and 2 act. DRTOL, NRCYCK, DRFCTR, TSSFDR, IRELAL and EDTTL belong to IDRFLG = 1. See the user guide."},
    {.name = "*CONTROL_OUTPUT", .cards = output_cards, .card_count = 5, .read = read_output, .remark = ""},
};

const KeywordFamily keyword_family_control = {"Control", specs, (int)(sizeof specs / sizeof *specs)};
