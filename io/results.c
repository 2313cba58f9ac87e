/* Results of a run: opening, continuing after a restart, states and flushing. The histories have a file each. */
#include "io/results.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "io/results_files.h"
#include "io/vtkhdf_mesh.h"
#include "solver/memory.h"

#define GRID_NAME "results.vtkhdf"
#define XDMF_NAME "results.xdmf"

static const HistoryFormat *const formats[HISTORY_COUNT] = {
    [HISTORY_GLSTAT] = &results_glstat_format, [HISTORY_ABSTAT] = &results_abstat_format,
    [HISTORY_NODOUT] = &results_nodout_format, [HISTORY_ABSTAT_PARTS] = &results_abstat_parts_format,
    [HISTORY_RBDOUT] = &results_rbdout_format, [HISTORY_MATSUM] = &results_matsum_format,
    [HISTORY_RWFORC] = &results_rwforc_format, [HISTORY_RCFORC] = &results_rcforc_format,
    [HISTORY_GCEOUT] = &results_gceout_format,
};

static char *join_path(const char *dir, const char *name)
{
    size_t size = strlen(dir) + strlen(name) + 2;
    char *path = memory_alloc(size, 1);
    if (path) snprintf(path, size, "%s/%s", dir, name);
    return path;
}

static int report_memory(Diagnostics *diagnostics)
{
    diagnostics_add(diagnostics, SEVERITY_ENVIRONMENT, BILLOW_NO_SOURCE, NULL, "not enough memory to write results");
    return -1;
}

static int check_folder(const char *dir, Diagnostics *diagnostics)
{
    struct stat status;
    if (stat(dir, &status) == 0 && !S_ISDIR(status.st_mode)) {
        diagnostics_add(diagnostics, SEVERITY_ENVIRONMENT, BILLOW_NO_SOURCE, NULL,
                        "%s is not a folder; choose another one for the results with -o", dir);
        return -1;
    }
    if (access(dir, R_OK | W_OK | X_OK) == 0) return 0;
    diagnostics_add(diagnostics, SEVERITY_ENVIRONMENT, BILLOW_NO_SOURCE, NULL,
                    "cannot write into the folder %s: %s; choose another one with -o", dir, strerror(errno));
    return -1;
}

static int remove_path(const char *path, Diagnostics *diagnostics)
{
    if (remove(path) == 0 || errno == ENOENT) return 0;
    diagnostics_add(diagnostics, SEVERITY_ENVIRONMENT, BILLOW_NO_SOURCE, NULL, "cannot replace %s: %s", path,
                    strerror(errno));
    return -1;
}

/* Deletes everything an earlier run may have left under our names. */
static int remove_old_files(Results *results)
{
    int status = 0;
    for (int k = 0; k < HISTORY_COUNT; k++) status |= history_remove(&results->history[k]);
    status |= remove_path(results->grid_path, results->diagnostics);
    return status | remove_path(results->xdmf_path, results->diagnostics) ? -1 : 0;
}

/* Opens results.xdmf anew with all states of the grid. */
static int start_xdmf(Results *results, const Model *model)
{
    MeshCount count = vtkhdf_count_cells(model);
    bool mixed = count.triangles > 0 && count.quads > 0;
    int64_t corners = 3 * (int64_t)count.triangles + 4 * (int64_t)count.quads;
    const XdmfMesh mesh = {.point_count = model->node_count,
                           .cell_count = model->element_count,
                           .topology_length = mixed ? corners + model->element_count : corners,
                           .erodes = model->has_erosion,
                           .corner_count = mixed             ? 0
                                           : count.quads > 0 ? 4
                                                             : 3};
    if (xdmf_create(results->xdmf_path, GRID_NAME, &mesh, &results->xdmf, results->diagnostics)) return -1;
    for (int i = 0; i < vtkhdf_state_count(results->grid); i++) {
        if (xdmf_add_state(results->xdmf, i, vtkhdf_state_time(results->grid, i)) == 0) continue;
        xdmf_close(results->xdmf);
        results->xdmf = NULL;
        return -1;
    }
    return 0;
}

/* Cuts every file back to the restart time. */
static int continue_files(Results *results, const Model *model, double restart_time)
{
    for (int k = 0; k < HISTORY_COUNT; k++)
        if (history_truncate(&results->history[k], restart_time)) return -1;
    if (access(results->grid_path, F_OK)) return remove_path(results->xdmf_path, results->diagnostics);
    return vtkhdf_append(results->grid_path, model, restart_time, &results->grid, results->diagnostics) ||
                   start_xdmf(results, model)
               ? -1
               : 0;
}

/* Initial centre of mass of each part, the elements' masses shared equally by their corners. */
static void find_part_centres(const Model *model, double *centre)
{
    for (int e = 0; e < model->element_count; e++) {
        const int32_t *node = model->element_node + 4 * (ptrdiff_t)e;
        int corners = node[3] == node[2] ? 3 : 4, p = model->element_part[e];
        if (!(model->parts[p].mass > 0)) continue;
        double share = model->element_mass[e] / (corners * model->parts[p].mass);
        for (int k = 0; k < corners; k++)
            for (int c = 0; c < 3; c++)
                centre[3 * (ptrdiff_t)p + c] += share * model->initial[3 * (ptrdiff_t)node[k] + c];
    }
    for (int s = 0; s < model->solid_count; s++) {
        const Solid *solid = &model->solids[s];
        for (int k = 0; k < 8; k++)
            for (int c = 0; c < 3; c++)
                centre[3 * (ptrdiff_t)solid->part + c] += solid->share[k] / model->parts[solid->part].mass *
                                                          model->initial[3 * (ptrdiff_t)solid->node[k] + c];
    }
}

static int allocate_results(Results *results, const char *dir, const Model *model)
{
    for (int k = 0; k < HISTORY_COUNT; k++)
        if (history_create(&results->history[k], formats[k], dir, results->diagnostics)) return -1;
    results->grid_path = join_path(dir, GRID_NAME);
    results->xdmf_path = join_path(dir, XDMF_NAME);
    results->part_flow = memory_alloc(2 * (size_t)model->part_count + 2, sizeof(double));
    results->part_centre = memory_alloc((size_t)model->part_count + 1, 3 * sizeof(double));
    if (!results->grid_path || !results->xdmf_path || !results->part_flow || !results->part_centre)
        return report_memory(results->diagnostics);
    find_part_centres(model, results->part_centre);
    return 0;
}

int results_open(const char *dir, const Model *model, bool append, double restart_time, Results **results,
                 Diagnostics *diagnostics)
{
    *results = NULL;
    if (check_folder(dir, diagnostics)) return -1;
    Results *opened = memory_alloc(1, sizeof *opened);
    if (!opened) return report_memory(diagnostics);
    opened->diagnostics = diagnostics;
    if (allocate_results(opened, dir, model) ||
        (append ? continue_files(opened, model, restart_time) : remove_old_files(opened))) {
        results_close(opened);
        return -1;
    }
    *results = opened;
    return 0;
}

int results_write_state(Results *results, const Model *model, const State *state, const StepView *view)
{
    double time = state->clock->time;
    if (!results->grid && vtkhdf_create(results->grid_path, model, &results->grid, results->diagnostics)) return -1;
    if (!results->xdmf && start_xdmf(results, model)) return -1;
    int before = vtkhdf_state_count(results->grid);
    if (vtkhdf_write_state(results->grid, model, state, time, view->x, view->v, view->contact)) return -1;
    return vtkhdf_state_count(results->grid) > before ? xdmf_add_state(results->xdmf, before, time) : 0;
}

int results_flush(Results *results)
{
    int status = 0;
    for (int k = 0; k < HISTORY_COUNT; k++)
        if (history_flush(&results->history[k])) status = -1;
    return status;
}

int results_close(Results *results)
{
    int status = 0;
    if (!results) return 0;
    for (int k = 0; k < HISTORY_COUNT; k++)
        if (history_close(&results->history[k])) status = -1;
    if (vtkhdf_close(results->grid)) status = -1;
    if (xdmf_close(results->xdmf)) status = -1;
    memory_free(results->grid_path);
    memory_free(results->xdmf_path);
    memory_free(results->part_flow);
    memory_free(results->part_centre);
    memory_free(results);
    return status;
}
