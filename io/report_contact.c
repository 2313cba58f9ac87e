/* The report of contacts: who meets whom, and what lies too near or through each other at the start. */
#include <math.h>

#include "contact/contact_check.h"
#include "io/report.h"
#include "solver/vector3.h"

enum { LISTED_NODES = 200 };

static const char *kind_name(ContactKind kind)
{
    switch (kind) {
    case CONTACT_SELF:
        return "single surface";
    case CONTACT_TWO_WAY:
        return "surface to surface";
    case CONTACT_ONE_WAY:
        return "one way surface to surface";
    case CONTACT_NODES_TO_SURFACE:
        return "nodes to surface";
    }
    return "?";
}

/* The list that IGNORE = 2 asks for. */
typedef struct NearList {
    const Model *model;
    FILE *stream;
    int count;
} NearList;

static void list_near(void *user, const ContactInterface *contact, int node, double distance, double thickness,
                      const double shift[3])
{
    NearList *list = user;
    const double *x = list->model->initial + 3 * (ptrdiff_t)node;
    if (contact->ignore != 2 || list->count++ >= LISTED_NODES) return;
    fprintf(list->stream, "    node %d at (%.8g, %.8g, %.8g): %.4g of %.4g; clear at (%.8g, %.8g, %.8g)\n",
            list->model->node_id[node], x[0], x[1], x[2], distance, thickness, x[0] + shift[0], x[1] + shift[1],
            x[2] + shift[2]);
}

static void write_findings(const Model *model, const ContactFindings *f, const NearList *list, FILE *stream)
{
    if (list->count > LISTED_NODES) fprintf(stream, "    and %d more\n", list->count - LISTED_NODES);
    if (f->near_count > 0)
        fprintf(stream,
                "    at the start %d node%s nearer than the thickness (%d in the very place): nearest node %d, %.3g of "
                "it, at (%.6g, %.6g, %.6g); they push only when they come nearer still\n",
                f->near_count, f->near_count == 1 ? " is" : "s are", f->touch_count, model->node_id[f->nearest_node],
                f->nearest, f->place[0], f->place[1], f->place[2]);
    else
        fprintf(stream, "    at the start no node is nearer than the thickness\n");
    if (f->cross_count > 0)
        fprintf(
            stream,
            "    at the start %d edge%s through a surface: the first between nodes %d and %d, at (%.6g, %.6g, %.6g)\n",
            f->cross_count, f->cross_count == 1 ? " goes" : "s go", model->node_id[f->cross_edge[0]],
            model->node_id[f->cross_edge[1]], f->cross_place[0], f->cross_place[1], f->cross_place[2]);
}

/* Signed distance of a probe at the start. */
static double start_gap(const Model *model, const ContactEntity *e, int probe)
{
    double r[3], local[3];
    for (int k = 0; k < 3; k++) {
        r[k] = -e->origin[k];
        for (int i = 0; i < 4; i++) r[k] += e->weight[4 * probe + i] * model->initial[3 * e->node[4 * probe + i] + k];
    }
    matrix3_apply(e->axes, r, local);
    return entity_gap(e, local).distance - e->radius[probe];
}

static void write_profile(const RevolvedProfile *profile, FILE *stream)
{
    double low = profile->end[1], high = low, widest = profile->end[0];
    for (int i = 0; i < profile->edge_count; i++) {
        low = fmin(low, profile->edge[i].z);
        high = fmax(high, profile->edge[i].z);
        widest = fmax(widest, profile->edge[i].r);
    }
    fprintf(stream, ", z from %.6g to %.6g, radius up to %.6g, %d edges", low, high, widest, profile->edge_count);
    for (int end = 0; end < 2; end++)
        if (revolved_profile_open(profile, end))
            fprintf(stream, ", open at z = %.6g", end == 0 ? profile->edge[0].z : profile->end[1]);
}

static void write_sizes(const ContactEntity *e, FILE *stream)
{
    if (e->shape == ENTITY_SPHERE || e->shape == ENTITY_CYLINDER) fprintf(stream, ", radius %.6g", e->size[0]);
    if (e->shape == ENTITY_ELLIPSOID)
        fprintf(stream, ", half axes %.6g, %.6g, %.6g", e->size[0], e->size[1], e->size[2]);
    if (e->shape == ENTITY_HULL)
        fprintf(stream, ", %d corners and %d faces", e->hull.corner_count, e->hull.plane_count);
    if (e->shape == ENTITY_TORUS) fprintf(stream, ", radius %.6g of a tube of radius %.6g", e->size[0], e->size[1]);
    if (e->shape == ENTITY_PROFILE) write_profile(&e->profile, stream);
    if (e->shape != ENTITY_RECTANGLE) return;
    fprintf(stream, ", %.6g x %.6g, corners", 2.0 * e->size[0], 2.0 * e->size[1]);
    for (int corner = 0; corner < 4; corner++) {
        double x[3], a = corner == 0 || corner == 3 ? -e->size[0] : e->size[0],
                     b = corner < 2 ? -e->size[1] : e->size[1];
        for (int k = 0; k < 3; k++) x[k] = e->origin[k] + a * e->axes[k] + b * e->axes[3 + k];
        fprintf(stream, "%s (%.6g, %.6g, %.6g)", corner > 0 ? "," : "", x[0], x[1], x[2]);
    }
}

static void write_entity(const Model *model, const ContactEntity *e, FILE *stream)
{
    static const char *const shapes[] = {"plane",       "sphere", "cylinder",     "ellipsoid",
                                         "convex mesh", "torus",  "finite plane", "body of revolution"};
    int inside = 0, worst = -1;
    double deepest = -1e-9 * (e->size[0] + e->thickest); /* on the surface is not inside */
    for (int p = 0; p < e->probe_count; p++) {
        double gap = start_gap(model, e, p);
        inside += gap < -1e-9 * (e->size[0] + e->thickest);
        if (gap < deepest) worst = p;
        deepest = gap < deepest ? gap : deepest;
    }
    fprintf(stream, "  entity %d: %s%s on %s part %d, at (%.6g, %.6g, %.6g)", e->id, e->inside ? "inside of a " : "",
            shapes[e->shape], e->body < 0 ? "fixed" : "rigid", e->part_id, e->origin[0], e->origin[1], e->origin[2]);
    write_sizes(e, stream);
    fprintf(stream, "; %d nodes", e->node_count);
    if (e->probe_count > e->node_count) fprintf(stream, " and %d points", e->probe_count - e->node_count);
    if (e->friction > 0.0) fprintf(stream, ", friction %.4g", e->friction);
    if (inside == 0)
        fprintf(stream, "\n    at the start none of them is within it\n");
    else if (e->open)
        fprintf(stream, "\n    at the start %d of them are behind it; it holds only what comes through it later\n",
                inside);
    else
        fprintf(stream,
                "\n    at the start %d of them are within it, the deepest by %.4g at node %d; they push only when "
                "they come deeper still\n",
                inside, -deepest, model->node_id[e->node[4 * worst]]);
}

/* Layers that start crossed stay tangled: told to those who read no report, too. */
static void warn_of_crossings(const Model *model, const ContactInterface *c, const ContactFindings *f,
                              Diagnostics *diagnostics)
{
    if (f->cross_count == 0) return;
    diagnostics_add(diagnostics, SEVERITY_WARNING, c->source, "*CONTACT",
                    "contact %d: %d edge%s through a surface at the start, the first between nodes %d and %d at (%.6g, "
                    "%.6g, %.6g); what is crossed stays tangled: part the layers in the mesh (billow check tells the "
                    "pairs of shells)",
                    c->id, f->cross_count, f->cross_count == 1 ? " goes" : "s go", model->node_id[f->cross_edge[0]],
                    model->node_id[f->cross_edge[1]], f->cross_place[0], f->cross_place[1], f->cross_place[2]);
}

void report_write_contacts(const Model *model, Diagnostics *diagnostics, FILE *stream)
{
    if (!model_has_contact(model)) return;
    fprintf(stream, "\nContacts\n--------\n");
    for (int i = 0; i < model->contact_count; i++) {
        const ContactInterface *c = &model->contacts[i];
        NearList list = {model, stream, 0};
        ContactFindings findings;
        fprintf(stream, "  contact %d%s%s: %s, %d nodes, %d triangles, %d edges; thickness up to %.6g", c->id,
                c->title[0] ? " " : "", c->title, kind_name(c->kind), c->node_count, c->triangle_count, c->edge_count,
                c->thickest);
        if (c->static_friction > 0.0 || c->dynamic_friction > 0.0)
            fprintf(stream, ", friction %.4g", c->static_friction);
        fputc('\n', stream);
        if (contact_inspect(model, c, model->initial, &findings, list_near, &list)) continue;
        write_findings(model, &findings, &list, stream);
        warn_of_crossings(model, c, &findings, diagnostics);
    }
    for (int i = 0; i < model->entity_count; i++) write_entity(model, &model->entities[i], stream);
}
