/* A deck's file read into memory. */
#ifndef BILLOW_DECK_FILE_H
#define BILLOW_DECK_FILE_H

#include <stdbool.h>
#include <stddef.h>

typedef struct DeckFile {
    char *text; /* length bytes and a terminating zero; owned by the caller, memory_free */
    size_t length;
    unsigned long long device, inode;
} DeckFile;

/* Reads a regular file. Returns NULL, or what is wrong in words (static text); *no_memory tells the one cause that is
 * not the user's. Devices, pipes and directories are refused without being read. */
const char *deck_file_read(const char *path, DeckFile *file, bool *no_memory);

/* True if something is there that could be opened as a file. */
bool deck_file_exists(const char *path);

#endif
