/* What one keyword means for another, as far as it needs no geometry: states by count. */
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

void keyword_check_references(Definitions *definitions, Diagnostics *diagnostics)
{
    resolve_state_counts(definitions, diagnostics);
}
