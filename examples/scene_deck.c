/* Scene decks: numbers, cards and keywords of LS-DYNA keyword text. */
#include "examples/scene.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "solver/memory.h"

void scene_text_free(SceneText *deck)
{
    memory_free(deck->text);
    *deck = (SceneText){0};
}

void scene_print(SceneText *deck, const char *format, ...)
{
    va_list arguments, again;
    va_start(arguments, format);
    va_copy(again, arguments);
    int needed = vsnprintf(NULL, 0, format, arguments);
    va_end(arguments);
    if (needed < 0 || deck->failed ||
        memory_reserve((void **)&deck->text, &deck->capacity, deck->length + (size_t)needed + 1, 1)) {
        deck->failed = true;
    } else {
        vsnprintf(deck->text + deck->length, (size_t)needed + 1, format, again);
        deck->length += (size_t)needed;
    }
    va_end(again);
}

enum { NUMBER_LENGTH = 32, FIELD_COLUMNS = 10 };

/* The shortest text that reads back to the same number. */
static void format_number(double value, char text[NUMBER_LENGTH])
{
    if (value == floor(value) && fabs(value) < 1e9) {
        snprintf(text, NUMBER_LENGTH, "%.0f", value == 0 ? 0.0 : value);
        return;
    }
    for (int digits = 1; digits <= 17; digits++) {
        snprintf(text, NUMBER_LENGTH, "%.*g", digits, value);
        if (strtod(text, NULL) == value) break;
    }
}

void scene_card(SceneText *deck, int count, const double *fields)
{
    bool columns = true;
    char text[NUMBER_LENGTH];
    for (int i = 0; i < count; i++) {
        format_number(fields[i], text);
        columns = columns && strlen(text) < FIELD_COLUMNS;
    }
    for (int i = 0; i < count; i++) {
        format_number(fields[i], text);
        if (columns)
            scene_print(deck, "%*s", FIELD_COLUMNS, text);
        else
            scene_print(deck, i ? ",%s" : "%s", text);
    }
    scene_print(deck, count == 1 && !columns ? ",\n" : "\n");
}

void scene_begin(SceneText *deck, const char *title, double end_time, double tssfac)
{
    scene_print(deck, "*KEYWORD\n*TITLE\n%s\n*CONTROL_TERMINATION\n", title);
    scene_card(deck, 1, &end_time);
    if (tssfac > 0) {
        scene_print(deck, "*CONTROL_TIMESTEP\n$   dtinit    tssfac\n");
        SCENE_CARD(deck, 0, tssfac);
    }
}

void scene_write_nodes(SceneText *deck, const SceneMesh *mesh)
{
    for (int i = 0; i < mesh->node_count; i++) {
        const double *x = mesh->x + 3 * i;
        if (deck->exact)
            scene_print(deck, "%d,%.17g,%.17g,%.17g\n", i + 1, x[0], x[1], x[2]);
        else
            scene_print(deck, "%8d%16.9E%16.9E%16.9E\n", i + 1, x[0], x[1], x[2]);
    }
}

void scene_end(SceneText *deck, const SceneMesh *mesh)
{
    scene_print(deck, "*NODE\n");
    scene_write_nodes(deck, mesh);
    scene_print(deck, "*ELEMENT_SHELL\n");
    for (int e = 0; e < mesh->shell_count; e++) {
        const int *n = mesh->shell[e];
        scene_print(deck, "%8d%8d%8d%8d%8d%8d\n", e + 1, mesh->part[e], n[0] + 1, n[1] + 1, n[2] + 1, n[3] + 1);
    }
    scene_print(deck, "*END\n");
}

void scene_write_output(SceneText *deck, double glstat, double abstat, double states)
{
    const struct {
        const char *name;
        double interval;
    } output[3] = {{"GLSTAT", glstat}, {"ABSTAT", abstat}, {"BINARY_D3PLOT", states}};
    for (int i = 0; i < 3; i++) {
        if (output[i].interval <= 0) continue;
        scene_print(deck, "*DATABASE_%s\n", output[i].name);
        scene_card(deck, 1, &output[i].interval);
    }
}

void scene_write_part(SceneText *deck, int part, int section, int material, const char *title)
{
    scene_print(deck, "*PART\n%s\n", title);
    SCENE_CARD(deck, part, section, material);
}

void scene_write_section(SceneText *deck, int section, int elform, double thickness)
{
    scene_print(deck, "*SECTION_SHELL\n$    secid    elform      shrf       nip\n");
    SCENE_CARD(deck, section, elform, 1, 1);
    SCENE_CARD(deck, thickness, thickness, thickness, thickness);
}

SceneFabric scene_isotropic(int form, bool cse, double density, double e, double nu)
{
    return (SceneFabric){.form = form,
                         .cse = cse,
                         .density = density,
                         .ea = e,
                         .eb = e,
                         .gab = e / (2 * (1 + nu)),
                         .prba = nu,
                         .prab = nu};
}

void scene_write_fabric(SceneText *deck, int material, const SceneFabric *fabric)
{
    const SceneFabric *f = fabric;
    if (f->elastic) {
        scene_write_elastic(deck, material, f->density, f->ea, f->prba);
        return;
    }
    scene_print(deck, "*MAT_FABRIC\n$      mid        ro        ea        eb                prba      prab\n");
    SCENE_CARD(deck, material, f->density, f->ea, f->eb, 0, f->prba, f->prab);
    scene_print(deck, "$      gab                           cse        el       prl    lratio      damp\n");
    SCENE_CARD(deck, f->gab, 0, 0, f->cse, f->el, f->prl, f->lratio, f->damp);
    if (f->tension_factor != 0.0) {
        scene_print(deck, "$     aopt       flc       fac       ela      lnrc      form     fvopt    tsrfac\n");
        SCENE_CARD(deck, f->aopt, 0, 0, 0, 0, f->form, 0, f->tension_factor);
    } else {
        scene_print(deck, "$     aopt       flc       fac       ela      lnrc      form\n");
        SCENE_CARD(deck, f->aopt, 0, 0, 0, 0, f->form);
    }
    scene_print(deck, "$             rgbrth     a0ref        a1        a2        a3\n");
    SCENE_CARD(deck, 0, 0, 0, f->vector[0], f->vector[1], f->vector[2]);
    scene_print(deck, "$       v1        v2        v3                              beta\n");
    SCENE_CARD(deck, 0, 0, 0, 0, 0, 0, f->beta);
}

void scene_write_elastic(SceneText *deck, int material, double density, double e, double nu)
{
    scene_print(deck, "*MAT_ELASTIC\n$      mid        ro         e        pr\n");
    SCENE_CARD(deck, material, density, e, nu);
}

void scene_write_null(SceneText *deck, int material, double density)
{
    scene_print(deck, "*MAT_NULL\n$      mid        ro\n");
    SCENE_CARD(deck, material, density);
}

void scene_write_rigid(SceneText *deck, int material, double density, int con1, int con2)
{
    scene_print(deck, "*MAT_RIGID\n$      mid        ro         e        pr\n");
    SCENE_CARD(deck, material, density, 2e11, 0.3);
    scene_print(deck, "$      cmo      con1      con2\n");
    SCENE_CARD(deck, 1, con1, con2);
    SCENE_CARD(deck, 0, 0, 0, 0, 0, 0);
}

void scene_write_curve(SceneText *deck, int curve, int count, const double *pairs)
{
    scene_print(deck, "*DEFINE_CURVE\n%10d\n", curve);
    for (int i = 0; i < count; i++) {
        char x[NUMBER_LENGTH], y[NUMBER_LENGTH];
        format_number(pairs[2 * i], x);
        format_number(pairs[2 * i + 1], y);
        scene_print(deck, strlen(x) < 20 && strlen(y) < 20 ? "%20s%20s\n" : "%s,%s\n", x, y);
    }
}

void scene_write_ramp(SceneText *deck, int curve, double rise, double value)
{
    if (rise > 0)
        scene_write_curve(deck, curve, 2, (const double[]){0, 0, rise, value});
    else
        scene_write_curve(deck, curve, 2, (const double[]){0, value, 1, value});
}

int scene_write_node_set(SceneText *deck, int set, const SceneMesh *mesh, SceneSelect *select, const void *user)
{
    int count = 0;
    scene_print(deck, "*SET_NODE_LIST\n%10d", set);
    for (int i = 0; i < mesh->node_count; i++) {
        const double x[3] = {mesh->x[3 * i], mesh->x[3 * i + 1], mesh->x[3 * i + 2]};
        if (!select(user, x)) continue;
        scene_print(deck, count % 8 == 0 ? "\n%10d" : "%10d", i + 1);
        count++;
    }
    scene_print(deck, "\n");
    return count;
}

void scene_write_spc(SceneText *deck, int set, bool x, bool y, bool z)
{
    scene_print(deck, "*BOUNDARY_SPC_SET\n$     nsid       cid      dofx      dofy      dofz\n");
    SCENE_CARD(deck, set, 0, x, y, z, 0, 0, 0);
}

void scene_write_part_set(SceneText *deck, int set, int count, const int *parts)
{
    scene_print(deck, "*SET_PART_LIST\n%10d\n", set);
    for (int i = 0; i < count; i++) scene_print(deck, "%10d", parts[i]);
    scene_print(deck, "\n");
}

void scene_write_pressure(SceneText *deck, int set, const SceneMesh *mesh, int part, int curve, double scale)
{
    scene_print(deck, "*SET_SEGMENT\n%10d\n", set);
    for (int e = 0; e < mesh->shell_count; e++) {
        const int *n = mesh->shell[e];
        if (part == 0 || mesh->part[e] == part)
            scene_print(deck, "%10d%10d%10d%10d\n", n[0] + 1, n[1] + 1, n[2] + 1, n[3] + 1);
    }
    scene_print(deck, "*LOAD_SEGMENT_SET\n$     ssid      lcid        sf        at\n");
    SCENE_CARD(deck, set, curve, -scale, 0);
}

void scene_write_damping(SceneText *deck, int curve, double value)
{
    scene_print(deck, "*DAMPING_GLOBAL\n$     lcid    valdmp\n");
    SCENE_CARD(deck, curve, value);
}

static void write_motion(SceneText *deck, const char *kind, int id, int dof, int vad, int curve, double scale)
{
    scene_print(deck, "*BOUNDARY_PRESCRIBED_MOTION_%s\n$       id       dof       vad      lcid        sf\n", kind);
    SCENE_CARD(deck, id, dof, vad, curve, scale);
}

void scene_write_motion(SceneText *deck, int node, int dof, int vad, int curve, double scale)
{
    write_motion(deck, "NODE", node, dof, vad, curve, scale);
}

void scene_write_rigid_motion(SceneText *deck, int part, int dof, int vad, int curve, double scale)
{
    write_motion(deck, "RIGID", part, dof, vad, curve, scale);
}

void scene_write_gravity(SceneText *deck, int curve, double g)
{
    scene_print(deck, "*LOAD_BODY_Z\n$     lcid        sf\n");
    SCENE_CARD(deck, curve, g);
}
