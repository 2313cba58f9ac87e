/* A deck's file read into memory. */
#include "io/deck_file.h"

#include <errno.h>
#include <fcntl.h>
#include <stdint.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "solver/memory.h"

bool deck_file_exists(const char *path)
{
    struct stat status;
    return stat(path, &status) == 0;
}

static const char *explain_open(int error)
{
    switch (error) {
    case ENOENT:
    case ENOTDIR:
        return "there is no such file";
    case EACCES:
        return "the file may not be read; check its permissions";
    case ENAMETOOLONG:
        return "the file's name is too long";
    case ELOOP:
        return "the file's symbolic links run in a circle";
    default:
        return "the file cannot be opened";
    }
}

/* Reads what the open file holds into file->text. */
static const char *read_content(int descriptor, size_t size, DeckFile *file, bool *no_memory)
{
    file->text = size < SIZE_MAX / 4 ? memory_alloc(size + 1, 1) : NULL;
    if (!file->text) {
        *no_memory = true;
        return "no memory left to read the file";
    }
    while (file->length < size) {
        ssize_t got = read(descriptor, file->text + file->length, size - file->length);
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) {
            memory_free(file->text);
            file->text = NULL;
            return "the file cannot be read to its end";
        }
        if (got == 0) break;
        file->length += (size_t)got;
    }
    file->text[file->length] = '\0';
    return NULL;
}

const char *deck_file_read(const char *path, DeckFile *file, bool *no_memory)
{
    *file = (DeckFile){0};
    *no_memory = false;
    /* Without O_NONBLOCK opening a pipe that nobody writes to would wait for ever. */
    int descriptor = open(path, O_RDONLY | O_NONBLOCK | O_CLOEXEC);
    if (descriptor < 0) return explain_open(errno);
    const char *problem = NULL;
    struct stat status;
    if (fstat(descriptor, &status) != 0) {
        problem = "the file cannot be examined";
    } else if (S_ISDIR(status.st_mode)) {
        problem = "this is a directory; name the deck's file in it";
    } else if (!S_ISREG(status.st_mode)) {
        problem = "this is no regular file; copy the deck into one";
    } else {
        file->device = (unsigned long long)status.st_dev;
        file->inode = (unsigned long long)status.st_ino;
        problem = read_content(descriptor, (size_t)status.st_size, file, no_memory);
    }
    close(descriptor);
    return problem;
}
