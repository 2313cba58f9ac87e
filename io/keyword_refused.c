/* Keywords that billow knows and does not have, with what to use in their place: errors that say more than that a name
 * is unknown. */
#include "io/keyword_table.h"

#define REFUSED(keyword, reason)                                                                                       \
    {                                                                                                                  \
        .name = keyword, .state = KEYWORD_REFUSED, .remark = reason, .prefix = true                                    \
    }
static const KeywordSpec specs[] = {
    REFUSED("*AIRBAG_PARTICLE",
            "there are no gas particles; write the bag's gas with uniform pressure, e.g. *AIRBAG_HYBRID"),
    REFUSED("*AIRBAG_ALE", "there is no flow field; write the bag's gas with uniform pressure, e.g. *AIRBAG_HYBRID"),
    REFUSED("*AIRBAG_CPG", "there is no flow field; write the bag's gas with uniform pressure, e.g. *AIRBAG_HYBRID"),
    REFUSED("*CONTACT_INTERIOR", "it keeps soft solids from turning inside out, and there are no deformable solids"),
    REFUSED("*CONTACT_RIGID", "rigid bodies meet by *CONTACT_AUTOMATIC_SURFACE_TO_SURFACE, with a stable penalty in "
                              "place of force curves"),
    REFUSED("*CONTACT_TIED", "nothing is tied; share nodes, or use *CONSTRAINED_TIED_NODES_FAILURE for nodes in one "
                             "place and *CONSTRAINED_EXTRA_NODES for nodes on a rigid part"),
    REFUSED("*DEFINE_TABLE", "a fabric takes one curve for each fibre; write the curve of the uniaxial test at the "
                             "strain rate of the problem as *DEFINE_CURVE"),
    REFUSED("*ELEMENT_INERTIA", "nodes have no rotations; give a rigid part or nodal rigid body the option INERTIA"),
    REFUSED("*ELEMENT_MASS_MATRIX", "a mass is the same in all directions; use *ELEMENT_MASS"),
    REFUSED("*ELEMENT_SEATBELT_ACCELEROMETER", "nodout has the accelerations of nodes, rbdout those of rigid bodies"),
    REFUSED("*ELEMENT_SEATBELT_PRETENSIONER", "straps have neither retractors nor pretensioners"),
    REFUSED("*ELEMENT_SEATBELT_RETRACTOR", "straps have neither retractors nor pretensioners"),
    REFUSED("*ELEMENT_SEATBELT_SENSOR", "straps have neither retractors nor pretensioners that it could fire"),
    REFUSED("*ELEMENT_SEATBELT_SLIPRING", "straps do not slide through rings; end the strap at the ring's node"),
    REFUSED("*INITIAL_FOAM_REFERENCE_GEOMETRY",
            "it is for solids and rubber; shells of *MAT_FABRIC take *AIRBAG_REFERENCE_GEOMETRY"),
    REFUSED("*LOAD_BODY_PARTS", "body loads act on the whole model; *LOAD_GRAVITY_PART acts on parts"),
    REFUSED("*LOAD_THERMAL", "fabric has no thermal strain"),
    REFUSED("*MAT_ADD_THERMAL_EXPANSION", "fabric has no thermal strain"),
};

const KeywordFamily keyword_family_refused = {"Refused keywords", specs, (int)(sizeof specs / sizeof *specs)};
