/* The part of the report on reference geometries. */
#include "io/report.h"

/* From when on, with which step, and what the material makes of it. */
static void write_group(const Model *model, const ElementGroup *group, FILE *stream)
{
    fprintf(stream, "    part %d: %d %s from time %.6g on, step by the %s geometry", model->parts[group->part].id,
            group->element_count, group->corner_count == 3 ? "triangles" : "quadrilaterals", group->birth,
            group->rdt ? "reference" : "current");
    if (group->rule.liner_waits) fprintf(stream, ", liners wait until taut (LNRC)");
    if (group->rule.keeps_tension) fprintf(stream, ", with its initial tension (ISREFG)");
    if (group->rule.restore != RESTORE_NEVER) fprintf(stream, ", initial tension comes back (TSRFAC)");
    fputc('\n', stream);
}

void report_write_reference(const Model *model, FILE *stream)
{
    if (!model->has_reference) return;
    fprintf(stream, "\nReference geometry\n------------------\n");
    fprintf(stream, "  %8s %9s %13s %13s %13s %13s %13s\n", "part", "elements", "mesh area", "reference", "mesh mass",
            "reference", "mass used");
    for (int i = 0; i < model->part_count; i++) {
        const Part *part = &model->parts[i];
        if (part->reference_count == 0) continue;
        double used = 0.0;
        for (int e = 0; e < model->element_count; e++)
            if (model->element_part[e] == i) used += model->element_mass[e];
        fprintf(stream, "  %8d %9d %13.6g %13.6g %13.6g %13.6g %13.6g\n", part->id, part->reference_count,
                part->referred_area, part->reference_area, part->referred_mass, part->reference_mass, used);
    }
    fprintf(stream, "  the mass is the reference's where it acts from the start, else the mesh's\n");
    for (int g = 0; g < model->group_count; g++)
        if (model->groups[g].has_reference) write_group(model, &model->groups[g], stream);
}
