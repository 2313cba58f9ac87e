/* Scene meshes as data: growth, welding, affine maps, seams, selections. */
#include "examples/scene.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "solver/memory.h"

void scene_mesh_free(SceneMesh *mesh)
{
    memory_free(mesh->x);
    memory_free(mesh->shell);
    memory_free(mesh->part);
    *mesh = (SceneMesh){0};
}

int scene_add_node(SceneMesh *mesh, double x, double y, double z)
{
    size_t count = (size_t)mesh->node_count;
    if (mesh->failed || memory_reserve((void **)&mesh->x, &mesh->node_capacity, 3 * count + 3, sizeof *mesh->x)) {
        mesh->failed = true;
        return 0;
    }
    memcpy(mesh->x + 3 * count, (double[3]){x, y, z}, 3 * sizeof(double));
    return mesh->node_count++;
}

void scene_add_shell(SceneMesh *mesh, int part, int a, int b, int c, int d)
{
    size_t count = (size_t)mesh->shell_count;
    if (mesh->failed || memory_reserve((void **)&mesh->shell, &mesh->shell_capacity, count + 1, sizeof *mesh->shell) ||
        memory_reserve((void **)&mesh->part, &mesh->part_capacity, count + 1, sizeof *mesh->part)) {
        mesh->failed = true;
        return;
    }
    memcpy(mesh->shell[count], (int[4]){a, b, c, d}, 4 * sizeof(int));
    mesh->part[count] = part;
    mesh->shell_count++;
}

typedef struct SortedNode {
    double key;
    int index;
} SortedNode;

static int compare_nodes(const void *left, const void *right)
{
    const SortedNode *a = left, *b = right;
    if (a->key != b->key) return a->key < b->key ? -1 : 1;
    return (a->index > b->index) - (a->index < b->index);
}

static double distance_squared(const double *a, const double *b)
{
    double dx = a[0] - b[0], dy = a[1] - b[1], dz = a[2] - b[2];
    return dx * dx + dy * dy + dz * dz;
}

/* target[i]: the lowest node within the tolerance of node i, by a sweep along x. */
static void find_clusters(const SceneMesh *mesh, int first, double tolerance, SortedNode *sorted, int *target)
{
    int count = mesh->node_count - first;
    for (int i = 0; i < count; i++) sorted[i] = (SortedNode){mesh->x[3 * (first + i)], first + i};
    for (int i = 0; i < mesh->node_count; i++) target[i] = i;
    qsort(sorted, (size_t)count, sizeof *sorted, compare_nodes);
    for (int i = 0; i < count; i++) {
        for (int j = i + 1; j < count && sorted[j].key - sorted[i].key <= tolerance; j++) {
            int a = sorted[i].index, b = sorted[j].index;
            if (distance_squared(mesh->x + 3 * a, mesh->x + 3 * b) > tolerance * tolerance) continue;
            int least = target[a] < target[b] ? target[a] : target[b];
            target[a] = least;
            target[b] = least;
        }
    }
}

void scene_weld(SceneMesh *mesh, int first, double tolerance)
{
    if (mesh->failed) return;
    int count = mesh->node_count;
    SortedNode *sorted = memory_alloc((size_t)(count - first) + 1, sizeof *sorted);
    int *target = memory_alloc((size_t)count + 1, sizeof *target);
    if (!sorted || !target) {
        mesh->failed = true;
    } else {
        find_clusters(mesh, first, tolerance, sorted, target);
        int kept = 0;
        for (int i = 0; i < count; i++) {
            if (target[i] != i) { /* a lower node, already given its new index */
                target[i] = target[target[i]];
                continue;
            }
            memmove(mesh->x + 3 * kept, mesh->x + 3 * i, 3 * sizeof(double));
            target[i] = kept++;
        }
        mesh->node_count = kept;
        for (int e = 0; e < mesh->shell_count; e++)
            for (int c = 0; c < 4; c++) mesh->shell[e][c] = target[mesh->shell[e][c]];
    }
    memory_free(sorted);
    memory_free(target);
}

void scene_sew_copy(SceneMesh *mesh, int part, SceneSelect *shared, const void *user)
{
    if (mesh->failed) return;
    int nodes = mesh->node_count, shells = mesh->shell_count;
    int *twin = memory_alloc((size_t)nodes + 1, sizeof *twin);
    if (!twin) {
        mesh->failed = true;
        return;
    }
    for (int i = 0; i < nodes; i++) {
        double x[3] = {mesh->x[3 * i], mesh->x[3 * i + 1], mesh->x[3 * i + 2]};
        twin[i] = shared(user, x) ? i : scene_add_node(mesh, x[0], x[1], x[2]);
    }
    for (int e = 0; e < shells; e++) {
        int n[4];
        memcpy(n, mesh->shell[e], sizeof n);
        if (n[3] == n[2])
            scene_add_shell(mesh, part, twin[n[0]], twin[n[2]], twin[n[1]], twin[n[1]]);
        else
            scene_add_shell(mesh, part, twin[n[0]], twin[n[3]], twin[n[2]], twin[n[1]]);
    }
    memory_free(twin);
}

void scene_transform(SceneMesh *mesh, int first, const double matrix[9], const double shift[3])
{
    for (int i = first; i < mesh->node_count; i++) {
        double *x = mesh->x + 3 * i, y[3];
        for (int r = 0; r < 3; r++)
            y[r] = matrix[3 * r] * x[0] + matrix[3 * r + 1] * x[1] + matrix[3 * r + 2] * x[2] + shift[r];
        memcpy(x, y, sizeof y);
    }
}

void scene_reverse(SceneMesh *mesh, int first, int end)
{
    for (int e = first; e < end && e < mesh->shell_count; e++) {
        int *n = mesh->shell[e];
        bool triangle = n[3] == n[2];
        int second = n[1];
        n[1] = n[3];
        n[3] = second;
        if (triangle) n[2] = second;
    }
}

int scene_retag(SceneMesh *mesh, int from, int to, SceneSelect *select, const void *user)
{
    int count = 0;
    for (int e = 0; e < mesh->shell_count; e++) {
        const int *n = mesh->shell[e];
        int corners = n[3] == n[2] ? 3 : 4;
        double centre[3] = {0, 0, 0};
        for (int k = 0; k < corners; k++)
            for (int c = 0; c < 3; c++) centre[c] += mesh->x[3 * n[k] + c] / corners;
        if (mesh->part[e] != from || !select(user, centre)) continue;
        mesh->part[e] = to;
        count++;
    }
    return count;
}

void scene_drop_part(SceneMesh *mesh, int part)
{
    if (mesh->failed) return;
    int *target = memory_alloc((size_t)mesh->node_count + 1, sizeof *target);
    if (!target) {
        mesh->failed = true;
        return;
    }
    int shells = 0, nodes = 0;
    for (int e = 0; e < mesh->shell_count; e++) {
        if (mesh->part[e] == part) continue;
        memmove(mesh->shell[shells], mesh->shell[e], sizeof mesh->shell[e]);
        mesh->part[shells++] = mesh->part[e];
    }
    mesh->shell_count = shells;
    for (int e = 0; e < shells; e++)
        for (int c = 0; c < 4; c++) target[mesh->shell[e][c]] = 1;
    for (int i = 0; i < mesh->node_count; i++) {
        if (!target[i]) continue;
        memmove(mesh->x + 3 * nodes, mesh->x + 3 * i, 3 * sizeof(double));
        target[i] = nodes++;
    }
    mesh->node_count = nodes;
    for (int e = 0; e < shells; e++)
        for (int c = 0; c < 4; c++) mesh->shell[e][c] = target[mesh->shell[e][c]];
    memory_free(target);
}

bool scene_select_all(const void *user, const double x[3])
{
    (void)user;
    (void)x;
    return true;
}

bool scene_select_radius(const void *radius, const double x[3])
{
    double r = *(const double *)radius;
    return fabs(sqrt(x[0] * x[0] + x[1] * x[1]) - r) < 1e-9 * r;
}

bool scene_select_plane(const void *plane, const double x[3])
{
    const ScenePlane *p = plane;
    return fabs(x[p->axis] - p->value) <= p->tolerance;
}
