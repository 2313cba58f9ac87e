/* Order of the corners in a table of panels: Boyer and Moore's majority over the shells at each node. */
#include "solver/reference_order.h"

#include <string.h>

#include "solver/memory.h"

int reference_order_create(int node_count, ReferenceOrder *order)
{
    size_t nodes = (size_t)node_count + 1;
    *order = (ReferenceOrder){.node_count = node_count,
                              .stand = memory_alloc(nodes, sizeof *order->stand),
                              .votes = memory_alloc(nodes, sizeof *order->votes),
                              .uses = memory_alloc(nodes, sizeof *order->uses)};
    return order->stand && order->votes && order->uses ? 0 : -1;
}

void reference_order_free(ReferenceOrder *order)
{
    memory_free(order->stand);
    memory_free(order->votes);
    memory_free(order->uses);
}

/* The panel's node at corner a if the corners are taken first places on, forwards or backwards. */
static int32_t taken(const PanelShell *shell, int first, int step, int a)
{
    return shell->corner[(step * (first + a) + 8 * shell->corner_count) % shell->corner_count];
}

/* Corners at which the neighbours agree in that order. */
static int agreeing(const ReferenceOrder *order, const PanelShell *shell, int first, int step)
{
    int count = 0;
    for (int a = 0; a < shell->corner_count; a++) {
        int32_t node = taken(shell, first, step, a);
        count += order->uses[node] > 1 && order->stand[node] == shell->node[a];
    }
    return count;
}

/* A vote of all shells in that order; returns the corners that do not get what they voted for. */
static int vote(ReferenceOrder *order, const PanelShell *shells, int count, int first, int step)
{
    memset(order->votes, 0, (size_t)order->node_count * sizeof *order->votes);
    memset(order->uses, 0, (size_t)order->node_count * sizeof *order->uses);
    for (int i = 0; i < count; i++) {
        for (int a = 0; shells[i].shell >= 0 && a < shells[i].corner_count; a++) {
            int32_t node = taken(&shells[i], first, step, a);
            if (order->votes[node] == 0) order->stand[node] = shells[i].node[a];
            order->votes[node] += order->stand[node] == shells[i].node[a] ? 1 : -1;
            order->uses[node]++;
        }
    }
    int lost = 0;
    for (int i = 0; i < count; i++)
        for (int a = 0; shells[i].shell >= 0 && a < shells[i].corner_count; a++)
            lost += order->stand[taken(&shells[i], first, step, a)] != shells[i].node[a];
    return lost;
}

CornerOrder reference_order_vote(ReferenceOrder *order, const PanelShell *shells, int count)
{
    CornerOrder found = CORNERS_FIT;
    int corners = 0, given = vote(order, shells, count, 0, 1), least = given;
    for (int i = 0; i < count; i++) corners += shells[i].shell >= 0 ? shells[i].corner_count : 0;
    if (8 * given <= corners) return CORNERS_FIT;
    for (int step = 1; step >= -1; step -= 2) {
        for (int first = -1; first < 3; first++) { /* -1: the same for triangles and quadrilaterals */
            int lost = vote(order, shells, count, first, step);
            if (4 * lost >= given || lost >= least) continue;
            least = lost;
            found = step > 0 ? CORNERS_TURNED : CORNERS_REVERSED;
        }
    }
    vote(order, shells, count, 0, 1);
    return found;
}

bool reference_order_differs(const ReferenceOrder *order, const PanelShell *shell)
{
    int given = agreeing(order, shell, 0, 1);
    for (int first = 0; first < shell->corner_count; first++)
        for (int step = -1; step <= 1; step += 2)
            if (agreeing(order, shell, first, step) > given) return true;
    return false;
}
