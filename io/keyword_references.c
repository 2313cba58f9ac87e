/* What one keyword means for another, as far as it needs no geometry: fabric leakage, states by count. */
#include <string.h>

#include "io/keyword_table.h"

/* Whether any fabric of the deck would leak: FLC times FAC, either of them a number or a curve. */
static const MaterialDefinition *find_leaking_fabric(const Definitions *d)
{
    for (size_t i = 0; i < d->materials.count; i++) {
        const MaterialDefinition *material = &d->materials.items[i];
        if (material->kind == MATERIAL_FABRIC && material->fabric.flc != 0.0 && material->fabric.fac != 0.0)
            return material;
    }
    return NULL;
}

/* OPT switches CP23 and AP23 off and lets the fabric itself leak, which billow does not have yet. */
static void check_leakage(const Definitions *d, const AirbagDefinition *bag, Diagnostics *diagnostics)
{
    if (bag->model != AIRBAG_WANG_NEFSKE || bag->opt == 0.0) return;
    const MaterialDefinition *leaking = find_leaking_fabric(d);
    if (leaking) {
        diagnostics_add(
            diagnostics, SEVERITY_ERROR, bag->card5, "*AIRBAG_WANG_NEFSKE",
            "OPT = %g asks for leakage through the fabric (FLC and FAC of material %d), which billow " BILLOW_VERSION
            " does not read; set OPT to 0 and use CP23 and AP23",
            bag->opt, leaking->id);
        return;
    }
    const bool given = (bag->cp23 != 0.0 || bag->lccp23 != 0) && (bag->ap23 != 0.0 || bag->lcap23 != 0);
    diagnostics_add(
        diagnostics, SEVERITY_WARNING, bag->card5, "*AIRBAG_WANG_NEFSKE",
        "OPT = %g asks for leakage through the fabric, but no *MAT_FABRIC has both FLC and FAC: there is none%s",
        bag->opt, given ? ", and OPT switches CP23 and AP23 off" : "");
}

/* NPLTC states up to the end time. */
static void resolve_state_counts(Definitions *d, Diagnostics *diagnostics)
{
    for (size_t i = 0; i < d->databases.count; i++) {
        DatabaseDefinition *database = &d->databases.items[i];
        if (database->npltc <= 0 || strcmp(database->name, "BINARY_D3PLOT") != 0) continue;
        if (d->control.termination.endtim > 0.0) {
            database->dt = d->control.termination.endtim / database->npltc;
        } else {
            diagnostics_add(diagnostics, SEVERITY_WARNING, database->source, "*DATABASE_BINARY_D3PLOT",
                            "NPLTC = %d needs ENDTIM of *CONTROL_TERMINATION; DT counts instead", database->npltc);
        }
    }
}

void keyword_check_references(Definitions *definitions, Diagnostics *diagnostics)
{
    for (size_t i = 0; i < definitions->airbags.count; i++)
        check_leakage(definitions, &definitions->airbags.items[i], diagnostics);
    resolve_state_counts(definitions, diagnostics);
}
