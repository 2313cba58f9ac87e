/* What one keyword means for another, as far as it needs no geometry: states by count, outlines that
 * nothing uses. */
#include <string.h>

#include "io/keyword_table.h"

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

/* Curves that are general x-y data: one that no profile uses is told of, one with a curve's number is an error. */
static void check_outlines(Definitions *d, Diagnostics *diagnostics)
{
    for (size_t i = 0; i < d->outlines.count; i++) {
        const CurveDefinition *outline = &d->outlines.items[i], *other = NULL;
        bool used = false;
        for (size_t k = 0; k < d->entities.count; k++)
            used = used || (d->entities.items[k].geotyp == 11 && d->entities.items[k].g[0] == outline->id);
        for (size_t k = 0; k < d->curves.count; k++)
            if (d->curves.items[k].id == outline->id) other = &d->curves.items[k];
        for (size_t k = 0; k < i; k++)
            if (d->outlines.items[k].id == outline->id) other = &d->outlines.items[k];
        if (other)
            diagnostics_add(diagnostics, SEVERITY_ERROR, outline->source, "*DEFINE_CURVE",
                            "curve %d is defined a second time (also in line %d); give it another id or remove one of "
                            "them",
                            outline->id, other->source.line);
        else if (!used)
            diagnostics_add(diagnostics, SEVERITY_WARNING, outline->source, "*DEFINE_CURVE",
                            "curve %d is general x-y data (DATTYP = 1) whose abscissae do not rise; only a profile of "
                            "*CONTACT_ENTITY (GEOTYP = 11) can use it, and it is left out",
                            outline->id);
    }
}

void keyword_check_references(Definitions *definitions, Diagnostics *diagnostics)
{
    resolve_state_counts(definitions, diagnostics);
    check_outlines(definitions, diagnostics);
}
