/* What the files of the loader share: the deck being loaded, where it stands, and who owns its text. */
#ifndef BILLOW_DECK_LOADER_H
#define BILLOW_DECK_LOADER_H

#include "io/card.h"
#include "io/parameters.h"

enum {
    BILLOW_INCLUDE_DEPTH = 32,    /* files within files */
    BILLOW_INCLUDE_FILES = 10000, /* files in all */
    BILLOW_LONGEST_LINE = 10000,  /* characters, tabs expanded */
    BILLOW_LONGEST_PATH = 4096,   /* terminating zero included */
};

/* The affine map of one *DEFINE_TRANSFORMATION. */
typedef struct Transformation {
    int id; /* with the IDDOFF of the file that defines it */
    double matrix[12];
    Source source;
} Transformation;

/* A node's card, for transformations given by nodes. */
typedef struct NodePlace {
    int id;
    double x[3];                       /* as written */
    const IncludeTransform *transform; /* of its file */
} NodePlace;

/* Owns everything that the blocks point at. */
typedef struct TextStore {
    LIST(void *) owned;   /* file buffers, arrays of lines, transforms */
    char *chunk;          /* room for expanded lines, one of the owned */
    size_t chunk_left;    /* bytes of it not yet used */
    LIST(char *) folders; /* of *INCLUDE_PATH, in order, each ending in a slash; owned */
    LIST(Transformation) transformations;
    LIST(NodePlace) nodes; /* read from the blocks before blocks_searched */
    size_t blocks_searched;
} TextStore;

/* Memory that lives as long as the deck, zeroed; NULL without memory (reported). */
struct DeckLoader;
void *loader_keep(struct DeckLoader *loader, size_t count, size_t size);

/* The same for a few characters. */
char *loader_keep_text(struct DeckLoader *loader, size_t length);

/* One file on the way from the main deck to the present one. */
typedef struct OpenFile {
    const char *name;
    unsigned long long device, inode; /* both 0 for a deck from memory */
} OpenFile;

typedef struct DeckLoader {
    DeckText *deck;
    Diagnostics *diagnostics;
    OpenFile open[BILLOW_INCLUDE_DEPTH];
    int depth;                         /* of the present file; the main deck is 0 */
    int file;                          /* Source.file of the present file */
    int scope;                         /* its inclusion */
    int file_count;                    /* loaded so far */
    size_t order;                      /* of the next block */
    bool wide, i10;                    /* as *KEYWORD says for the present file */
    const IncludeTransform *transform; /* of the present file, NULL for none */
} DeckLoader;

/* Adds an error about the present file. */
void loader_report_memory(DeckLoader *loader);

/* Loads the file at path, which the line at from asks for (BILLOW_NO_SOURCE: the main deck), and all that it includes.
 * Problems are reported. */
void loader_load_file(DeckLoader *loader, const char *path, Source from, const IncludeTransform *transform);

/* Splits the text of the present file, which is changed and kept, into blocks and hands them on. */
void loader_split_text(DeckLoader *loader, char *text, size_t length);

/* Takes a block whose lines are complete: uses it up or adds it to the deck. */
void loader_take_block(DeckLoader *loader, const DeckBlock *block);

/* True if the block is an *INCLUDE, *INCLUDE_PATH(_RELATIVE) or *INCLUDE_TRANSFORM and has been dealt with. */
bool loader_include(DeckLoader *loader, const DeckBlock *block);

/* True if the block is a *DEFINE_TRANSFORMATION and has been dealt with. */
bool loader_define_transformation(DeckLoader *loader, const DeckBlock *block);

/* The latest transformation of that id; NULL if there is none. */
const Transformation *loader_find_transformation(const DeckLoader *loader, int id);

/* The place of a node defined before the block, in the coordinates of the block's file; false if there is none. */
bool loader_find_node(DeckLoader *loader, const DeckBlock *block, int id, double x[3]);

#endif
