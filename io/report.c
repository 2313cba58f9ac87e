/* The report of an accepted deck: the text of billow check and of the log. */
#include "io/report.h"

#include <math.h>

#include "solver/element_steps.h"
#include "solver/memory.h"

enum { LISTED_BODIES = 20 };

static void write_heading(const char *heading, FILE *stream)
{
    fprintf(stream, "\n%s\n", heading);
    for (const char *c = heading; *c; c++) fputc('-', stream);
    fputc('\n', stream);
}

void report_write_keywords(const Definitions *d, FILE *stream)
{
    const struct {
        const char *name;
        size_t count;
    } counts[] = {
        {"nodes (*NODE)", d->nodes.count},
        {"shells (*ELEMENT_SHELL)", d->shells.count - d->face_count},
        {"solids (*ELEMENT_SOLID)", d->solids.count},
        {"parts (*PART)", d->parts.count},
        {"beams (*ELEMENT_BEAM)", d->beams.count},
        {"discrete elements (*ELEMENT_DISCRETE)", d->discretes.count},
        {"masses on nodes (*ELEMENT_MASS)", d->masses.count},
        {"masses on parts (*ELEMENT_MASS_PART)", d->part_masses.count},
        {"sections (*SECTION)",
         d->sections.count + d->solid_sections.count + d->beam_sections.count + d->discrete_sections.count},
        {"materials (*MAT)", d->materials.count},
        {"hourglass definitions (*HOURGLASS)", d->hourglasses.count},
        {"sets (*SET)", d->sets.count},
        {"curves (*DEFINE_CURVE)", d->curves.count},
        {"coordinate systems (*DEFINE_COORDINATE)", d->coordinates.count},
        {"vectors (*DEFINE_VECTOR)", d->vectors.count},
        {"boxes (*DEFINE_BOX)", d->boxes.count},
        {"hanging nodes (*CONSTRAINED_ADAPTIVITY)", d->adaptivities.count},
        {"seams (*CONSTRAINED_SPOTWELD)", d->spotwelds.count},
        {"erosion criteria (*MAT_ADD_EROSION)", d->erosions.count},
        {"sets of tied nodes (*CONSTRAINED_TIED_NODES_FAILURE)", d->tied_nodes.count},
        {"output intervals (*DATABASE)", d->databases.count},
        {"history entries (*DATABASE_HISTORY)", d->histories.count},
        {"supports (*BOUNDARY_SPC)", d->spcs.count},
        {"prescribed motions (*BOUNDARY_PRESCRIBED_MOTION)", d->motions.count},
        {"initial velocities (*INITIAL_VELOCITY)", d->velocities.count},
        {"node loads (*LOAD_NODE)", d->node_loads.count},
        {"loads of rigid bodies (*LOAD_RIGID_BODY)", d->rigid_loads.count},
        {"segment loads (*LOAD_SEGMENT)", d->segment_loads.count},
        {"body loads (*LOAD_BODY)", d->body_loads.count},
        {"gravity on parts (*LOAD_GRAVITY_PART)", d->gravity_parts.count},
        {"dampings (*DAMPING)", d->dampings.count},
        {"airbags (*AIRBAG)", d->airbags.count},
        {"rigid walls (*RIGIDWALL)", d->walls.count},
        {"joined rigid parts (*CONSTRAINED_RIGID_BODIES)", d->merges.count},
        {"extra nodes of rigid parts (*CONSTRAINED_EXTRA_NODES)", d->extra_nodes.count},
        {"nodal rigid bodies (*CONSTRAINED_NODAL_RIGID_BODY)", d->nodal_bodies.count},
        {"contacts (*CONTACT)", d->contacts.count},
        {"contact entities", d->entities.count},
    };
    write_heading("Keywords", stream);
    for (size_t i = 0; i < sizeof counts / sizeof *counts; i++)
        if (counts[i].count > 0) fprintf(stream, "  %-52s %9zu\n", counts[i].name, counts[i].count);
}

static const char *material_name(int kind)
{
    switch (kind) {
    case MATERIAL_FABRIC:
        return "fabric";
    case MATERIAL_ELASTIC:
        return "elastic";
    case MATERIAL_NULL:
        return "null";
    case MATERIAL_RIGID:
        return "rigid";
    case MATERIAL_SPRING:
        return "spring";
    case MATERIAL_DAMPER:
        return "damper";
    case MATERIAL_CABLE:
        return "cable";
    case MATERIAL_ORTHOTROPIC:
        return "orthotropic";
    case MATERIAL_RUBBER:
        return "rubber";
    case MATERIAL_BELT:
        return "strap";
    default:
        return "?";
    }
}

static void write_bodies(const Model *model, FILE *stream)
{
    for (int i = 0; i < model->rigid_body_count && i < LISTED_BODIES; i++) {
        const RigidBody *body = &model->rigid_bodies[i];
        fprintf(stream, "  moving rigid %s %d: mass %.6g, centre (%.6g, %.6g, %.6g), inertia %.6g %.6g %.6g\n",
                body->nodal ? "body" : "part", body->part_id, body->mass, body->centre[0], body->centre[1],
                body->centre[2], body->inertia[0], body->inertia[1], body->inertia[2]);
    }
    if (model->rigid_body_count > LISTED_BODIES)
        fprintf(stream, "  and %d more moving rigid parts\n", model->rigid_body_count - LISTED_BODIES);
}

/* Masses on nodes that count for no part; returns their sum. */
static double write_point_masses(const Model *model, FILE *stream)
{
    double mass = 0.0;
    int count = 0;
    for (int i = 0; i < model->point_mass_count; i++) {
        if (model->point_masses[i].part >= 0) continue;
        mass += model->point_masses[i].mass;
        count++;
    }
    if (count > 0) fprintf(stream, "  %8s %-8s %9d %12s %13s %13.6g  masses on nodes\n", "-", "-", count, "", "", mass);
    return mass;
}

void report_write_parts(const Model *model, FILE *stream)
{
    double mass = 0.0, area = 0.0;
    write_heading("Parts", stream);
    fprintf(stream, "  %d nodes, %d elements (%d deformable)\n", model->node_count, model->element_count,
            model->deformable_count);
    fprintf(stream, "  %8s %-8s %9s %12s %13s %13s  %s\n", "part", "material", "elements", "thickness", "area", "mass",
            "title");
    for (int i = 0; i < model->part_count; i++) {
        const Part *part = &model->parts[i];
        const double whole = part->mass + part->point_mass;
        fprintf(stream, "  %8d %-8s %9d %12.5g %13.6g %13.6g  %s\n", part->id, material_name(part->material_kind),
                part->element_count, part->thickness, part->area, whole, part->title);
        mass += whole;
        area += part->area;
    }
    mass += write_point_masses(model, stream);
    fprintf(stream, "  %8s %-8s %9d %12s %13.6g %13.6g\n", "total", "", model->element_count, "", area, mass);
    write_bodies(model, stream);
}

static void write_closure(const SurfaceClosure *closure, FILE *stream)
{
    fprintf(stream, "    surface: volume %.8g, area %.8g, %d edge-connected shell%s, %d segment%s turned\n",
            closure->volume, closure->area, closure->components, closure->components == 1 ? "" : "s", closure->turned,
            closure->turned == 1 ? "" : "s");
    fprintf(stream, "    free edges: %d, closed by %d cap%s and %d seam%s of hanging nodes\n", closure->free_edges,
            closure->holes, closure->holes == 1 ? "" : "s", closure->seams, closure->seams == 1 ? "" : "s");
    for (int i = 0; i < closure->holes; i++) {
        const SurfaceCap *cap = &closure->caps[i];
        fprintf(stream,
                "      cap %d: %d edges about (%.6g, %.6g, %.6g), area %.6g, out of plane by %.3g of its size, %s\n",
                i + 1, cap->count, cap->centre[0], cap->centre[1], cap->centre[2], cap->area, cap->planarity,
                cap->fixed_count == cap->count ? "all its nodes fixed"
                : cap->fixed_count > 0         ? "some of its nodes fixed"
                                               : "its nodes free");
    }
}

static void write_gas(const Airbag *bag, const GasState *gas, FILE *stream)
{
    const GasModel *model = &bag->gas;
    fprintf(stream, "    gas (%s): V %.8g, p %.6g, T %.6g, density %.6g, mass %.6g, energy %.6g\n",
            gas_name(model->kind), gas->volume, gas->pressure, gas->temperature, gas->density, gas->mass, gas->energy);
    for (int i = 0; i < model->species_count; i++)
        fprintf(stream, "    %s: molar mass %.6g, mass %.6g, cp %.6g at this temperature\n", model->species[i].name,
                model->species[i].molar_mass, gas->species[i], species_cp(&model->species[i], gas->temperature));
    if (model->kind == GAS_CHEMKIN)
        fprintf(stream, "    species of DATA = 2 are those of NASA TM-4513 (McBride, Gordon, Reno 1993)\n");
    if (model->temperature_dependent)
        fprintf(stream, "    heat capacity: molar cp = %.6g + %.6g T, molar mass %.6g\n", model->a, model->b,
                model->molar_mass);
    else if (model->cv > 0.0)
        fprintf(stream, "    heat capacities: cv %.6g, cp %.6g, gamma %.6g\n", model->cv, model->cp,
                model->cp / model->cv);
    fprintf(stream, "    outside: pressure %.6g; exit areas: vent %.6g, porosity %.6g\n", bag->ambient,
            model->vent_area, model->porosity_area);
    for (int i = 0; i < model->hole_count; i++)
        fprintf(stream, "    vent by a part: area %.6g at the start\n", model->holes[i].initial_area);
    for (int i = 0; i < model->leak_count; i++)
        fprintf(stream, "    leaking part: option %d, area %.6g at the start\n", model->leaks[i].option,
                model->leaks[i].initial_area);
}

/* What starts the inflow, and its jet. */
static void write_inflator(const Model *model, int airbag, FILE *stream)
{
    for (int i = 0; i < model->sensor_count; i++) {
        const Sensor *sensor = &model->sensors[i];
        if (model->sensor_airbag[i] != airbag) continue;
        fprintf(stream, "    sensor on part %d, %s: the inflow starts when it fires\n", sensor->part_id,
                sensor->function ? "the user's function" : "built in");
    }
    for (int i = 0; i < model->jet_count; i++) {
        const Jet *jet = &model->jets[i];
        if (jet->airbag != airbag) continue;
        fprintf(stream, "    jet%s: %s from (%.6g, %.6g, %.6g) towards (%.6g, %.6g, %.6g)%s",
                jet->same_momentum ? " of constant momentum" : "",
                jet->multiple ? "by angle"
                : jet->wedge  ? "wedge"
                              : "cone",
                jet->focus[0], jet->focus[1], jet->focus[2], jet->head[0], jet->head[1], jet->head[2],
                jet->moving ? ", on nodes" : "");
        if (jet->react_node >= 0) fprintf(stream, ", reaction on node %d", model->node_id[jet->react_node]);
        fputc('\n', stream);
    }
}

void report_write_airbags(const Model *model, const State *state, FILE *stream)
{
    if (model->airbag_count == 0) return;
    write_heading("Airbags", stream);
    for (int i = 0; i < model->airbag_count; i++) {
        const Airbag *bag = &model->airbags[i];
        fprintf(stream, "  airbag %d%s%s: %d part%s, %d nodes\n", bag->id, bag->heading[0] ? " " : "", bag->heading,
                bag->part_count, bag->part_count == 1 ? "" : "s", bag->node_count);
        write_closure(&bag->closure, stream);
        if (state) write_gas(bag, &state->gas[i], stream);
        write_inflator(model, i, stream);
    }
}

void report_write_conditions(const Model *model, FILE *stream)
{
    const Constraints *constraints = &model->constraints;
    const struct {
        const char *name;
        int count;
    } counts[] = {
        {"nodes that never move", model->node_count - model->moving_count},
        {"supports", constraints->support_count},
        {"prescribed motions", constraints->motion_count},
        {"hanging nodes tied to the middle of their edge", constraints->hanging_count},
        {"node loads", model->loads.node_load_count},
        {"loads of rigid bodies", model->loads.rigid_load_count},
        {"segment loads", model->segment_load_count},
        {"classes of body force and damping", model->loads.class_count > 1 ? model->loads.class_count - 1 : 0},
        {"moving rigid bodies", model->rigid_body_count},
        {"springs, cables and trusses", model->link_count},
        {"dampers", model->damper_count},
        {"masses on nodes", model->point_mass_count},
        {"pairs of nodes that a seam joins", model->seam_count},
        {"places at which nodes are tied", model->ties.count},
    };
    bool any = false;
    write_heading("Supports and loads", stream);
    for (size_t i = 0; i < sizeof counts / sizeof *counts; i++) {
        if (counts[i].count <= 0) continue;
        fprintf(stream, "  %-52s %9d\n", counts[i].name, counts[i].count);
        any = true;
    }
    if (!any) fprintf(stream, "  none\n");
}

static const char *wall_shape(const RigidWall *wall)
{
    switch (wall->shape) {
    case WALL_SPHERE:
        return "sphere";
    case WALL_CYLINDER:
        return "cylinder";
    case WALL_PRISM:
        return "prism";
    case WALL_PLANE:
        break;
    }
    return wall->length[0] > 0.0 || wall->length[1] > 0.0 ? "finite plane" : "plane";
}

void report_write_walls(const Model *model, FILE *stream)
{
    if (model->wall_count == 0) return;
    write_heading("Rigid walls", stream);
    for (int i = 0; i < model->wall_count; i++) {
        const RigidWall *wall = &model->walls[i];
        const double *o = wall->origin, *n = wall->axes + 6;
        fprintf(stream, "  wall %d%s%s: %s at (%.6g, %.6g, %.6g), n (%.6g, %.6g, %.6g)%s\n", wall->id,
                wall->title[0] ? " " : "", wall->title, wall_shape(wall), o[0], o[1], o[2], n[0], n[1], n[2],
                wall->mass > 0.0   ? ", moved by its nodes"
                : wall->curve >= 0 ? ", driven by a curve"
                                   : "");
        fprintf(stream, "    %d nodes, %d of them start behind the wall\n", wall->node_count, wall->behind_count);
        if (wall->pushed_count + wall->rigid_count > 0)
            fprintf(stream, "    of moving rigid parts: %d that bounce off it, %d that pass\n", wall->pushed_count,
                    wall->rigid_count);
    }
}

void report_write_steps(const Model *model, int limit, FILE *stream)
{
    write_heading("Stable time steps (elements in their reference geometry)", stream);
    if (model->added_mass > 0.0) fprintf(stream, "  mass added by DT2MS: %.6g\n", model->added_mass);
    ElementStep *list = memory_alloc((size_t)limit, sizeof *list);
    const int count = list ? element_steps_smallest(model, limit, list) : 0;
    if (count == 0) {
        fprintf(stream, "  no element sets the step: it follows the gas, the curves and the output interval\n");
    } else {
        const double mesh = element_steps_mesh(model);
        fprintf(stream, "  of the mesh, whose nodes share their elements: %.6g; times the scale factor %.4g: %.6g\n",
                mesh, model->step_scale, model->step_scale * mesh);
        if (model->implicit.element_count > 0)
            fprintf(stream,
                    "  %d of %d elements are much smaller than the rest and are integrated implicitly; with "
                    "--all-explicit the\n  mesh would have %.6g\n",
                    model->implicit.element_count, model->deformable_count, model->implicit.explicit_step);
        fprintf(stream, "  smallest of an element by itself: %.6g in element %d\n", list[0].step,
                model->element_id[list[0].element]);
        fprintf(stream, "  %10s %10s %14s\n", "element", "part", "step");
        for (int i = 0; i < count; i++)
            fprintf(stream, "  %10d %10d %14.6g\n", model->element_id[list[i].element],
                    model->parts[model->element_part[list[i].element]].id, list[i].step);
    }
    memory_free(list);
}

void report_write_plan(const Model *model, const OutputPlan *plan, FILE *stream)
{
    const struct {
        const char *name;
        double interval;
        bool present;
    } kinds[] = {
        {"states", plan->states, true},
        {"glstat", plan->glstat, true},
        {"matsum", plan->matsum, true},
        {"abstat", plan->abstat, model->airbag_count > 0},
        {"nodout", plan->nodout, plan->history_count > 0},
        {"rbdout", plan->rbdout, model->rigid_body_count > 0},
        {"rwforc", plan->rwforc, model->wall_count > 0},
        {"rcforc", plan->rcforc, model->contact_count > 0},
        {"gceout", plan->gceout, model->entity_count > 0},
    };
    write_heading("End and output", stream);
    fprintf(stream, "  end time %.9g", model->end_time);
    if (model->end_cycle > 0) fprintf(stream, ", at most %d cycles", model->end_cycle);
    fprintf(stream, "\n  output intervals:");
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++)
        if (kinds[i].present && kinds[i].interval > 0.0) fprintf(stream, " %s %.6g", kinds[i].name, kinds[i].interval);
    if (plan->restart > 0.0) fprintf(stream, " checkpoint every %.0f cycles", plan->restart);
    fputc('\n', stream);
}

void report_write_messages(const Diagnostics *diagnostics, FILE *stream)
{
    write_heading("Messages", stream);
    fprintf(stream, "  %d warning%s, %d note%s\n", diagnostics->warnings, diagnostics->warnings == 1 ? "" : "s",
            diagnostics->notes, diagnostics->notes == 1 ? "" : "s");
    diagnostics_print(diagnostics, SEVERITY_NOTE, stream);
}
