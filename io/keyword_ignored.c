/* Keywords that steer only output or numerics that billow does not have: skipped with a note that says why. Nothing
 * that changes the physics of a run belongs here. */
#include "io/keyword_table.h"

#define IGNORED(keyword, reason)                                                                                       \
    {                                                                                                                  \
        .name = keyword, .state = KEYWORD_IGNORED, .remark = reason                                                    \
    }
#define IGNORED_FAMILY(keyword, reason)                                                                                \
    {                                                                                                                  \
        .name = keyword, .state = KEYWORD_IGNORED, .remark = reason, .prefix = true                                    \
    }
static const KeywordSpec specs[] = {
    IGNORED_FAMILY("*CONTACT_FORCE_TRANSDUCER", "it only measures; rcforc has the force of each contact"),
    IGNORED("*CONTROL_ALE", "there are no ALE elements"),
    IGNORED("*CONTROL_CHECK_SHELL", "the build checks shells by itself"),
    IGNORED("*CONTROL_CPU", "stop a run with Ctrl-C or a d3kil file"),
    IGNORED("*CONTROL_DEBUG", "output only"),
    IGNORED_FAMILY("*CONTROL_MPP", "threads need no decomposition"),
    IGNORED("*CONTROL_NONLOCAL", "there are no nonlocal materials"),
    IGNORED("*CONTROL_PARALLEL",
            "the command line sets the threads; results have the same bits for any number of them"),
    IGNORED("*CONTROL_RIGID", "numerics of joints and output of rigid bodies"),
    IGNORED("*CONTROL_REQUIRE_REVISION", "asks for a revision of LS-DYNA"),
    IGNORED("*CONTROL_SOLID", "there are no solid elements"),
    IGNORED("*CONTROL_SOLUTION", "billow solves the structural problem only"),
    IGNORED("*CONTROL_SPH", "there are no particles"),
    IGNORED("*CONTROL_STRUCTURED", "output only"),
    IGNORED("*CONTROL_UNITS", "billow works in the deck's own units"),
    IGNORED_FAMILY("*DATABASE", "billow does not write this result"),
    IGNORED("*DATABASE_EXTENT_BINARY", "results.vtkhdf always has the same contents"),
    IGNORED("*DATABASE_HISTORY_NODE_LOCAL", "nodout has global components; name the nodes in *DATABASE_HISTORY_NODE"),
    IGNORED("*DATABASE_HISTORY_NODE_SET_LOCAL", "nodout has global components; use *DATABASE_HISTORY_NODE_SET"),
    IGNORED("*DATABASE_FORMAT", "results are VTKHDF, XDMF, CSV and LS-DYNA's ASCII layouts"),
};

const KeywordFamily keyword_family_ignored = {"Ignored keywords", specs, (int)(sizeof specs / sizeof *specs)};
