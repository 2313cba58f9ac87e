/* Sections of parts: what elements a part has, and which materials go with them. */
#include "solver/builder.h"

#define FIND(list, kind)                                                                                               \
    for (size_t i = 0; i < d->list.count; i++)                                                                         \
        if (d->list.items[i].id == id) {                                                                               \
            *place = (int)i;                                                                                           \
            return kind;                                                                                               \
        }

SectionKind part_section(const Definitions *d, int id, int *place)
{
    FIND(sections, SECTION_SHELL)
    FIND(solid_sections, SECTION_SOLID)
    FIND(beam_sections, SECTION_BEAM)
    FIND(discrete_sections, SECTION_DISCRETE)
    *place = -1;
    return SECTION_NONE;
}

static int refuse(Builder *b, const PartDefinition *definition, const char *elements, const char *material)
{
    diagnostics_add(b->diagnostics, SEVERITY_ERROR, definition->source, "*PART",
                    "part %d is of %s (section %d), which billow has for %s only; material %d is none", definition->id,
                    elements, definition->section, material, definition->material);
    return -1;
}

int part_material_check(Builder *b, const PartDefinition *definition, const PartRecord *record,
                        const MaterialDefinition *material)
{
    bool rigid = material->kind == MATERIAL_RIGID;
    if (record->kind == SECTION_SOLID) return rigid ? 0 : refuse(b, definition, "solids", "*MAT_RIGID");
    if (record->kind == SECTION_DISCRETE)
        return material->kind == MATERIAL_SPRING || material->kind == MATERIAL_DAMPER || material->kind == MATERIAL_BELT
                   ? 0
                   : refuse(
                         b, definition, "springs",
                         "*MAT_SPRING_ELASTIC and _NONLINEAR_ELASTIC, *MAT_DAMPER_VISCOUS and _NONLINEAR_VISCOUS and "
                         "*MAT_SEATBELT");
    const SectionBeamDefinition *section = &b->definitions->beam_sections.items[record->section];
    if (rigid) return 0;
    if (section->elform == 6)
        return material->kind == MATERIAL_CABLE
                   ? 0
                   : refuse(b, definition, "discrete beams", "*MAT_CABLE_DISCRETE_BEAM and *MAT_RIGID");
    if (section->elform == 3)
        return material->kind == MATERIAL_ELASTIC ? 0 : refuse(b, definition, "trusses", "*MAT_ELASTIC and *MAT_RIGID");
    return refuse(b, definition, "beams with bending", "*MAT_RIGID");
}

double beam_area(const SectionBeamDefinition *section)
{
    const double quarter_pi = 0.78539816339744831;
    double area = 0.0;
    switch (section->elform) {
    case 2:
    case 3:
    case 12:
    case 13:
        return section->a;
    case 6:
        return section->ca;
    default:
        break;
    }
    for (int end = 0; end < 2; end++) {
        double s = section->ts[end], t = section->tt[end];
        if (section->cst == 0.0) area += 0.5 * s * t;                        /* rectangle */
        if (section->cst == 1.0) area += 0.5 * quarter_pi * (s * s - t * t); /* tube of these diameters */
    }
    return area;
}
