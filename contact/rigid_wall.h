/* Rigid walls: shapes that nodes cannot enter. Geometry only; the step is in solver/step_walls.c. */
#ifndef BILLOW_RIGID_WALL_H
#define BILLOW_RIGID_WALL_H

#include <stdbool.h>
#include <stdint.h>

#include "solver/billow.h"

typedef enum WallShape {
    WALL_PLANE,    /* through the origin, infinite, rectangular or half of it */
    WALL_SPHERE,   /* about the origin */
    WALL_CYLINDER, /* axis n, from the origin along n; infinite both ways without a length */
    WALL_PRISM,    /* below the rectangle at the origin, to the depth given */
} WallShape;

/* What becomes of a node's sliding. */
typedef enum WallFriction {
    WALL_FRICTION, /* Coulomb's, with the coefficient; 0: none */
    WALL_NO_SLIDING,
} WallFriction;

/* Immutable; built by solver/build_walls.c, arrays owned by the Model. Axes are fixed in space, walls translate. */
typedef struct RigidWall {
    int id;
    char title[BILLOW_TITLE_LENGTH];
    WallShape shape;
    double origin[3]; /* at time 0 [L] */
    double axes[9];   /* rows l, m, n; n points out of the wall */
    double length[3]; /* extent along l and m from the origin, depth along -n (length along n of a cylinder); 0:
                         infinite [L] */
    double radius;    /* sphere, cylinder [L] */
    double tolerance; /* a gap above minus this is in front [L] */
    WallFriction sliding;
    double friction;     /* Coulomb's coefficient */
    bool welds;          /* nodes that hit it faster than weld_speed never leave it again */
    double weld_speed;   /* [L/T] */
    double birth, death; /* it acts while birth <= t_n < death [T] */
    double mass;         /* > 0: it moves along n by the momentum of the nodes [M] */
    double speed;        /* of such a wall at the start, along n [L/T] */
    int curve;         /* index into Model.curves of a prescribed motion along direction, -1 none; abscissa t - birth */
    bool displacement; /* the curve is the displacement, not the velocity */
    double direction[3];    /* of the prescribed motion, as written (its length scales the curve) */
    unsigned char *tracked; /* 1: the wall acts on this node (moving_count) */
    unsigned char *pushed;  /* 1: it pushes this node of a moving rigid body (moving_count); NULL: none */
    double penalty;         /* on such nodes: share of what is stable (eq. W12) */
    double *body_penalty;   /* stiffness x dt^2 on each such node of each moving rigid body; NULL: none [M] */
    int node_count;         /* nodes that the card names, fixed ones included */
    int behind_count;       /* of them, those that start behind the wall */
    int rigid_count;        /* of them, those of moving rigid parts that the wall does not see */
    int pushed_count;       /* of them, those of moving rigid parts that it pushes */
} RigidWall;

/* Mutable, plain data in the State buffer. */
typedef struct WallState {
    double shift; /* of a wall with mass along n at t_n [L] */
    double speed; /* of it at the half step [L/T] */
    int64_t born; /* 1: it has begun to act, its nodes' sides are known */
} WallState;

/* Side of a node with respect to a wall: values of State.wall_side. */
enum {
    WALL_SIDE_FRONT,
    WALL_SIDE_BEHIND, /* was there when the wall began to act: may move towards the front only */
    WALL_SIDE_PASSED, /* past the edge of a finite plane: the wall does not see it until it is in front again */
    WALL_SIDE_WELDED,
};

/* Where a point is: signed distance (negative inside or behind) and the outward normal at the nearest face. */
typedef struct WallGap {
    double distance; /* [L] */
    double normal[3];
    bool over; /* the point's projection lies on the wall: false beyond the edges of a finite plane */
} WallGap;

/* r: position relative to the wall's origin as it is now. */
WallGap rigid_wall_gap(const RigidWall *wall, const double r[3]);

#endif
