/* The deck as written: one record per keyword item, each with its place in the deck.
 * Filled by io/ (readers), consumed by solver/build_*.c, which validates and makes the Model.
 * Values are the deck's own units; defaults of the manual are already applied by the readers (zero or blank), names are
 * those of the cards in lower case. Ids are the user's. Zero means "not given" for ids of optional things. */
#ifndef BILLOW_DEFINITIONS_H
#define BILLOW_DEFINITIONS_H

#include <stdbool.h>
#include <stddef.h>

#include "solver/definitions_airbag.h"
#include "solver/definitions_contact.h"
#include "solver/definitions_control.h"
#include "solver/definitions_load.h"
#include "solver/definitions_material.h"
#include "solver/definitions_mesh.h"
#include "solver/definitions_reference.h"
#include "solver/definitions_rigid.h"
#include "solver/definitions_seam.h"
#include "solver/definitions_set.h"
#include "solver/record_list.h"

/* Everything of one deck. Zero-initialise, fill with deck_read (io/read.h), free with definitions_free. */
typedef struct Definitions {
    char title[BILLOW_TITLE_LENGTH];
    bool incomplete; /* a reader reported an error, so records may be missing: "X is not defined" would be its echo */
    LIST(NodeDefinition) nodes;
    LIST(ShellDefinition) shells;
    size_t face_count; /* the last so many shells are faces of solids */
    LIST(SolidDefinition) solids;
    LIST(SectionSolidDefinition) solid_sections;
    LIST(BeamDefinition) beams;
    LIST(SectionBeamDefinition) beam_sections;
    LIST(DiscreteDefinition) discretes;
    LIST(SectionDiscreteDefinition) discrete_sections;
    LIST(MassDefinition) masses;
    LIST(PartMassDefinition) part_masses;
    LIST(PartDefinition) parts;
    LIST(SectionShellDefinition) sections;
    LIST(MaterialDefinition) materials;
    LIST(HourglassDefinition) hourglasses;
    LIST(SetDefinition) sets;
    LIST(CurveDefinition) curves;
    LIST(CurveDefinition) outlines; /* DATTYP = 1 whose abscissae do not rise: points in the order of the deck */
    LIST(FunctionDefinition) functions;
    LIST(CoordinateDefinition) coordinates;
    LIST(VectorDefinition) vectors;
    LIST(BoxDefinition) boxes;
    LIST(AdaptivityDefinition) adaptivities;
    LIST(SpotweldDefinition) spotwelds;
    LIST(TiedNodesDefinition) tied_nodes;
    LIST(ErosionDefinition) erosions;
    ControlDefinitions control;
    LIST(DatabaseDefinition) databases;
    LIST(HistoryDefinition) histories;
    LIST(SpcDefinition) spcs;
    LIST(PrescribedMotionDefinition) motions;
    LIST(InitialVelocityDefinition) velocities;
    LIST(NodeLoadDefinition) node_loads;
    LIST(RigidLoadDefinition) rigid_loads;
    LIST(SegmentLoadDefinition) segment_loads;
    LIST(BodyLoadDefinition) body_loads;
    LIST(GravityPartDefinition) gravity_parts;
    LIST(DampingDefinition) dampings;
    LIST(AirbagDefinition) airbags;
    LIST(InteractionDefinition) interactions;
    LIST(PorosityDefinition) porosities;
    LIST(RigidWallDefinition) walls;
    LIST(RigidMergeDefinition) merges;
    LIST(ExtraNodesDefinition) extra_nodes;
    LIST(NodalRigidBodyDefinition) nodal_bodies;
    LIST(ReferenceBlockDefinition) reference_blocks;
    LIST(ReferenceNodeDefinition) reference_nodes;
    LIST(ReferenceShellDefinition) reference_shells;
    LIST(ContactDefinition) contacts;
    LIST(EntityDefinition) entities;
} Definitions;

void definitions_free(Definitions *definitions);

#endif
