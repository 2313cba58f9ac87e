/* Parts: materials and sections -> membrane laws, fibre axes, element kinds. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "solver/builder.h"
#include "solver/coordinates.h"
#include "solver/memory.h"

static const double degree = 0.017453292519943295;

static void copy3(double *to, double a, double b, double c)
{
    to[0] = a;
    to[1] = b;
    to[2] = c;
}

/* AOPT and BETA of a fabric. */
static int fabric_axis(Builder *b, const MaterialDefinition *m, PartRecord *part)
{
    const FabricCard *f = &m->fabric;
    part->angle += f->beta * degree;
    part->axis.kind = FIBRE_EDGE;
    if (f->aopt == 2.0) {
        part->axis.kind = FIBRE_VECTOR;
        copy3(part->axis.vector, f->a1, f->a2, f->a3);
    } else if (f->aopt == 3.0) {
        part->axis.kind = FIBRE_CROSS;
        copy3(part->axis.vector, f->v1, f->v2, f->v3);
    } else if (f->aopt < 0.0) {
        CoordinateSystem system;
        if (coordinates_resolve_system(&b->index, (int)-f->aopt, m->source, m->keyword, &system, b->diagnostics))
            return -1;
        part->axis.kind = FIBRE_VECTOR;
        memcpy(part->axis.vector, system.axes, sizeof part->axis.vector);
    } else if (f->aopt != 0.0) {
        diagnostics_add(b->diagnostics, SEVERITY_ERROR, m->source, m->keyword,
                        "AOPT = %g is not known; use 0, 2, 3 or minus a coordinate system", f->aopt);
        return -1;
    }
    const double *v = part->axis.vector;
    if (part->axis.kind != FIBRE_EDGE && v[0] == 0.0 && v[1] == 0.0 && v[2] == 0.0) {
        diagnostics_add(b->diagnostics, SEVERITY_ERROR, m->source, m->keyword,
                        "AOPT = %g needs a direction, but its vector is zero; fill in %s", f->aopt,
                        f->aopt == 2.0 ? "A1, A2, A3" : "V1, V2, V3");
        return -1;
    }
    return 0;
}

/* ISREFG: is the initial tension there from the start? */
static int fabric_tension(Builder *b, const MaterialDefinition *m, bool first_use, ReferenceRule *rule)
{
    const FabricCard *f = &m->fabric;
    if (f->isrefg != 0.0 && f->isrefg != 1.0) {
        diagnostics_add(b->diagnostics, SEVERITY_ERROR, m->source, m->keyword, "ISREFG = %g is not known; use 0 or 1",
                        f->isrefg);
        return -1;
    }
    rule->keeps_tension = f->isrefg == 1.0 && (f->is_map || f->form == 12);
    if (f->isrefg == 1.0 && !rule->keeps_tension && first_use)
        diagnostics_add(
            b->diagnostics, SEVERITY_WARNING, m->source, m->keyword,
            "ISREFG = 1 acts with FORM = 12 only, here FORM = %d: the initial tension is left out; use FORM "
            "12, or TSRFAC to bring it back",
            f->form);
    if (rule->keeps_tension && f->tsrfac != 0.0 && first_use)
        diagnostics_add(b->diagnostics, SEVERITY_WARNING, m->source, m->keyword,
                        "%s = %g has no effect beside ISREFG = 1: all of the initial tension acts from the start",
                        f->is_map ? "SRFAC" : "TSRFAC", f->tsrfac);
    return 0;
}

/* RGBRTH, ISREFG, LNRC and TSRFAC: what becomes of a reference geometry. */
static int fabric_reference(Builder *b, const MaterialDefinition *m, bool first_use, PartRecord *part)
{
    const FabricCard *f = &m->fabric;
    const bool has_liner = part->fabric.has_liner;
    ReferenceRule *rule = &part->reference_rule;
    part->has_reference = true;
    part->reference_birth = f->rgbrth;
    rule->curve = -1;
    if (b->definitions->reference_blocks.count == 0) {
        if (first_use && (f->lnrc != 0.0 || f->tsrfac != 0.0 || f->rgbrth != 0.0 || f->isrefg != 0.0))
            diagnostics_add(b->diagnostics, SEVERITY_NOTE, m->source, m->keyword,
                            "LNRC = %g, %s = %g, ISREFG = %g and RGBRTH = %g are not used: there is no reference "
                            "geometry",
                            f->lnrc, f->is_map ? "SRFAC" : "TSRFAC", f->tsrfac, f->isrefg, f->rgbrth);
        return 0;
    }
    if (f->lnrc != 0.0 && f->lnrc != 1.0) {
        diagnostics_add(b->diagnostics, SEVERITY_ERROR, m->source, m->keyword,
                        "LNRC = %g is not read by billow " BILLOW_VERSION "; use 0 or 1", f->lnrc);
        return -1;
    }
    if (f->lnrc == 1.0 && has_liner && f->cse != 1.0) {
        diagnostics_add(b->diagnostics, SEVERITY_ERROR, m->source, m->keyword,
                        "LNRC = 1 keeps a liner slack whose fabric carries compression (CSE = %g); use CSE = 1, or "
                        "LNRC = 0",
                        f->cse);
        return -1;
    }
    rule->liner_waits = f->lnrc == 1.0 && has_liner;
    if (fabric_tension(b, m, first_use, rule)) return -1;
    if (f->tsrfac == 0.0 || rule->keeps_tension) return 0;
    rule->restore = f->tsrfac >= 1.0 ? RESTORE_BY_TIME : RESTORE_BY_CYCLE;
    if (f->tsrfac > 0.0 && f->tsrfac < 1.0) {
        rule->factor = f->tsrfac;
        return 0;
    }
    rule->curve = deck_index_curve(&b->index, (int)fabs(f->tsrfac), f->is_map ? "SRFAC" : "TSRFAC", m->source,
                                   m->keyword, b->diagnostics);
    return rule->curve < 0 ? -1 : 0;
}

/* What all forms have in common. */
static int fabric_finish(Builder *b, const MaterialDefinition *m, bool first_use, PartRecord *part)
{
    part->fabric.no_compression = m->fabric.cse == 1.0;
    part->fabric.damping = m->fabric.damp > 0.0 ? m->fabric.damp : 0.0;
    if (fabric_reference(b, m, first_use, part)) return -1;
    return fabric_axis(b, m, part);
}

/* Is the fabric given by curves? FORM 4, 14 and -14 without any curve are FORM 3 and 13. */
static bool fabric_has_curves(const FabricCard *f)
{
    bool can = f->form == 4 || f->form == 14 || f->form == -14;
    return f->form == 24 || (can && (f->lca || f->lcb || f->lcab || f->lcua || f->lcub || f->lcuab || f->h != 0.0));
}

/* Moduli that cannot be; every one is named. */
static bool fabric_moduli_fail(Builder *b, const MaterialDefinition *m, bool first_use, bool by_curves)
{
    const FabricCard *f = &m->fabric;
    const char *names[] = {"EB", "GAB", "EL"};
    const double values[] = {f->eb, f->gab, f->el};
    bool fail = f->ea < 0.0 || (f->ea == 0.0 && !by_curves), share = !(f->lratio >= 0.0 && f->lratio <= 1.0);
    if (fail && first_use)
        diagnostics_add(b->diagnostics, SEVERITY_ERROR, m->source, m->keyword, "EA = %g must be positive", f->ea);
    for (int i = 0; i < 3; i++) {
        if (!(values[i] < 0.0)) continue;
        if (first_use)
            diagnostics_add(b->diagnostics, SEVERITY_ERROR, m->source, m->keyword, "%s = %g must not be negative",
                            names[i], values[i]);
        fail = true;
    }
    if (share && first_use)
        diagnostics_add(b->diagnostics, SEVERITY_ERROR, m->source, m->keyword, "LRATIO = %g must lie between 0 and 1",
                        f->lratio);
    if (f->lratio > 0.0 && f->el > 0.0 && !(f->prl > -1.0 && f->prl < 1.0)) {
        if (first_use)
            diagnostics_add(b->diagnostics, SEVERITY_ERROR, m->source, m->keyword, "PRL = %g must lie between -1 and 1",
                            f->prl);
        fail = true;
    }
    return fail || share;
}

/* MAT_FABRIC: EB, GAB default to the isotropic law of EA, PRBA as in LS-DYNA. */
static int fabric_law(Builder *b, const MaterialDefinition *m, bool first_use, PartRecord *part)
{
    const FabricCard *f = &m->fabric;
    Diagnostics *g = b->diagnostics;
    bool curves = fabric_has_curves(f);
    bool fail = fabric_moduli_fail(b, m, first_use, curves);
    if (curves && fabric_curve_law(b, m, first_use, part)) fail = true; /* all messages in one list */
    if (fail) return -1;
    if (curves) return fabric_finish(b, m, first_use, part);
    double eb = f->eb > 0.0 ? f->eb : f->ea, prab = f->prab != 0.0 ? f->prab : f->prba * f->ea / eb;
    double gab = f->gab > 0.0 ? f->gab : 0.5 * f->ea / (1.0 + f->prba);
    double mismatch = fabs(f->prba * f->ea - prab * eb);
    /* The manual's symmetry: PRBA/EB = PRAB/EA, thus PRBA EA = PRAB EB. */
    if (first_use && mismatch > 1e-6 * (fabs(f->prba * f->ea) + fabs(prab * eb)))
        diagnostics_add(g, SEVERITY_WARNING, m->source, m->keyword,
                        "PRBA = %g and PRAB = %g do not fit EA = %g and EB = %g (PRBA EA must equal PRAB EB); both are "
                        "used as given, their coupling stiffness is made symmetric by the mean",
                        f->prba, prab, f->ea, eb);
    PlaneModuli fabric = law_orthotropic(f->ea, eb, f->prba, prab, gab), liner = {0};
    bool has_liner = f->lratio > 0.0 && f->el > 0.0;
    if (fabric.d11 * fabric.d22 <= fabric.d12 * fabric.d12 || f->prba * prab >= 1.0) {
        diagnostics_add(g, SEVERITY_ERROR, m->source, m->keyword,
                        "EA = %g, EB = %g with PRBA = %g, PRAB = %g give an unstable material; lower Poisson's ratios",
                        f->ea, eb, f->prba, prab);
        return -1;
    }
    if (has_liner) liner = law_isotropic(f->el, f->prl);
    law_set(&part->fabric, fabric, liner, f->lratio, has_liner);
    part->law = f->form == 0 || f->form == 1 ? LAW_BIOT : LAW_GREEN;
    part->fabric.free_fold = part->law == LAW_BIOT;
    return fabric_finish(b, m, first_use, part);
}

/* The compression cut-off of FORM 0 and 1 with a Poisson's ratio has no stored energy (docs/theory.md, Energy). */
static void warn_of_undamped(Builder *b, const MaterialDefinition *m, const PartRecord *part)
{
    const FabricLaw *law = &part->fabric;
    if (part->law != LAW_BIOT || !law->no_compression || law->damping > 0.0 || law->fabric.d12 == 0.0) return;
    diagnostics_add(
        b->diagnostics, SEVERITY_WARNING, m->source, "*MAT_FABRIC",
        "material %d: FORM = %g with CSE = 1 and DAMP = 0 has no stored energy: accounts limit what it gives "
        "back; DAMP = 0.05 makes its crimps quieter",
        m->id, (double)m->fabric.form);
}

/* Is this the first part with its material? Messages about the material come once. */
static bool is_first_use(const Builder *b, const PartDefinition *definition)
{
    const PartDefinition *part = b->definitions->parts.items;
    while (part->material != definition->material) part++;
    return part == definition;
}

static double hourglass_modulus(const Builder *b, const PartDefinition *definition)
{
    const Definitions *d = b->definitions;
    double qh = d->control.hourglass.given ? d->control.hourglass.qh : 0.0;
    for (size_t i = 0; i < d->hourglasses.count; i++)
        if (definition->hourglass && d->hourglasses.items[i].id == definition->hourglass)
            qh = d->hourglasses.items[i].qm;
    return qh > 0.0 ? qh : 0.1;
}

/* Materials other than fabric also make shells with bending. */
static bool is_membrane(Builder *b, const PartDefinition *definition, const char *material,
                        const SectionShellDefinition *section)
{
    if (section->elform == 5 || section->elform == 9) return true;
    diagnostics_add(b->diagnostics, SEVERITY_ERROR, section->source, "*SECTION_SHELL",
                    "ELFORM = %d with %s is a shell with bending, which billow does not have; use the membranes 5 or 9 "
                    "(part %d)",
                    section->elform, material, definition->id);
    return false;
}

static int part_law(Builder *b, const PartDefinition *definition, const MaterialDefinition *m,
                    const SectionShellDefinition *section, PartRecord *part)
{
    part->density = m->ro;
    part->area_density = section->marea;
    part->quad = b->options->one_point_quads ? ELEMENT_QUAD_ONE : ELEMENT_QUAD_FULL;
    if (section->icomp == 1 && section->beta_count > 0) part->angle = section->beta[0] * degree;
    if (!(m->ro > 0.0) && !(section->marea > 0.0) && m->kind != MATERIAL_NULL && m->kind != MATERIAL_RIGID &&
        m->kind != MATERIAL_SPRING && m->kind != MATERIAL_DAMPER && m->kind != MATERIAL_CABLE &&
        m->kind != MATERIAL_BELT) {
        diagnostics_add(b->diagnostics, SEVERITY_ERROR, m->source, NULL,
                        "material %d has density RO = %g; it must be positive", m->id, m->ro);
        return -1;
    }
    switch (m->kind) {
    case MATERIAL_FABRIC:
        if (fabric_law(b, m, is_first_use(b, definition), part)) return -1;
        if (is_first_use(b, definition)) warn_of_undamped(b, m, part);
        break;
    case MATERIAL_ORTHOTROPIC:
        if (!is_membrane(b, definition, m->keyword, section)) return -1;
        if (fabric_law(b, m, is_first_use(b, definition), part)) return -1;
        if (section->elform == 5) part->quad = ELEMENT_QUAD_ONE;
        break;
    case MATERIAL_RUBBER:
        if (!is_membrane(b, definition, m->keyword, section)) return -1;
        if (rubber_law(b, m, is_first_use(b, definition), part)) return -1;
        if (section->elform == 5) part->quad = ELEMENT_QUAD_ONE;
        break;
    case MATERIAL_ELASTIC:
        if (!is_membrane(b, definition, "*MAT_ELASTIC", section)) return -1;
        if (!(m->e > 0.0) || !(m->pr > -1.0 && m->pr < 1.0)) {
            diagnostics_add(b->diagnostics, SEVERITY_ERROR, m->source, "*MAT_ELASTIC",
                            "E = %g must be positive and PR = %g between -1 and 1", m->e, m->pr);
            return -1;
        }
        law_set(&part->fabric, law_isotropic(m->e, m->pr), (PlaneModuli){0}, 0.0, false);
        part->law = LAW_LOGARITHMIC;
        if (section->elform == 5) part->quad = ELEMENT_QUAD_ONE;
        break;
    case MATERIAL_NULL:
    case MATERIAL_RIGID:
        part->law = LAW_SURFACE;
        break;
    case MATERIAL_SPRING:
    case MATERIAL_DAMPER:
    case MATERIAL_CABLE:
    case MATERIAL_BELT:
        diagnostics_add(
            b->diagnostics, SEVERITY_ERROR, definition->source, "*PART",
            "part %d is of shells, but its material %d is for springs, dampers, cables or straps; correct MID or SECID",
            definition->id, definition->material);
        return -1;
    }
    part->fabric.density = m->ro;
    part->fabric.hourglass = hourglass_modulus(b, definition);
    return 0;
}

static void fill_part(const PartDefinition *definition, const MaterialDefinition *material, int index, Part *part)
{
    part->id = definition->id;
    part->deck_index = index;
    memcpy(part->title, definition->title, sizeof part->title);
    part->material_id = definition->material;
    part->section_id = definition->section;
    part->material_kind = material->kind;
    part->rigid_body = -1;
    part->density = material->ro;
}

/* One part; -1 after an error. */
static int build_part(Builder *b, int index)
{
    const Definitions *d = b->definitions;
    const PartDefinition *definition = &d->parts.items[index];
    PartRecord *record = &b->parts[index];
    int status = 0;
    record->material = id_map_find(&b->index.materials, definition->material);
    record->kind = part_section(d, definition->section, &record->section);
    record->law = LAW_SURFACE;
    bool used = b->index.part_shell_start[index + 1] > b->index.part_shell_start[index];
    if (record->material < 0) {
        diagnostics_add(b->diagnostics, SEVERITY_ERROR, definition->source, "*PART",
                        "part %d names material MID = %d, which the deck does not define", definition->id,
                        definition->material);
        status = -1;
    }
    if (record->kind == SECTION_NONE && used) {
        diagnostics_add(b->diagnostics, SEVERITY_ERROR, definition->source, "*PART",
                        "part %d names section SECID = %d, which the deck does not define as *SECTION_SHELL, _SOLID, "
                        "_BEAM or _DISCRETE",
                        definition->id, definition->section);
        status = -1;
    }
    if (record->material < 0 || record->kind == SECTION_NONE) return status;
    const MaterialDefinition *material = &d->materials.items[record->material];
    if (record->kind != SECTION_SHELL) {
        status = part_material_check(b, definition, record, material);
        record->density = material->ro;
    } else {
        const SectionShellDefinition *section = &d->sections.items[record->section];
        status = part_law(b, definition, material, section, record);
        b->model->parts[index].thickness = section->t[0];
    }
    if (definition->has_inertia && material->kind != MATERIAL_RIGID) {
        diagnostics_add(b->diagnostics, SEVERITY_ERROR, definition->source, "*PART_INERTIA",
                        "part %d has an inertia of its own, but its material %d is not rigid; use *PART",
                        definition->id, definition->material);
        status = -1;
    }
    fill_part(definition, material, index, &b->model->parts[index]);
    return status;
}

int build_parts(Builder *b)
{
    const Definitions *d = b->definitions;
    int status = 0;
    b->parts = memory_alloc(d->parts.count + 1, sizeof *b->parts);
    Part *parts = builder_alloc(b, d->parts.count + 1, sizeof *parts);
    if (!b->parts || !parts) return -1;
    b->model->parts = parts;
    b->model->part_count = (int)d->parts.count;
    for (size_t i = 0; i < d->parts.count; i++)
        if (build_part(b, (int)i)) status = -1;
    return status;
}
