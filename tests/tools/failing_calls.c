/* Calls of the system that fail, for a program that loads this library before others. Reads of files whose names begin
 * with "failing" fail from the byte on that FAILING_FROM states. FAILING_LIMITS is the limit that cannot be set: memory
 * or time. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/time.h>
#include <unistd.h>

/* How many bytes of the file can still be read. */
static size_t readable(FILE* file) {
    char link[64], name[4096] = {0};
    const char* from = getenv("FAILING_FROM");
    const long at = ftell(file);
    snprintf(link, sizeof link, "/proc/self/fd/%d", fileno(file));
    if (from == NULL || at < 0 || readlink(link, name, sizeof name - 1) < 0 || strstr(name, "/failing") == NULL)
        return (size_t)-1;
    return atol(from) > at ? (size_t)(atol(from) - at) : 0;
}

size_t fread(void* target, size_t size, size_t count, FILE* file) {
    size_t (*call)(void*, size_t, size_t, FILE*) = (size_t(*)(void*, size_t, size_t, FILE*))dlsym(RTLD_NEXT, "fread");
    const size_t most = readable(file);
    if (size == 0 || size * count <= most) return call(target, size, count, file);
    const size_t read = call(target, size, most / size, file);
    if (read == most / size) errno = EIO;
    return read;
}

static int fails(const char* limit) {
    const char* failing = getenv("FAILING_LIMITS");
    errno = EPERM;
    return failing != NULL && strcmp(failing, limit) == 0;
}

int setrlimit(__rlimit_resource_t resource, const struct rlimit* limits) {
    return fails("memory") ? -1 : prlimit(0, resource, limits, NULL);
}

int setitimer(__itimer_which_t which, const struct itimerval* timer, struct itimerval* before) {
    int (*call)(__itimer_which_t, const struct itimerval*, struct itimerval*) =
        (int (*)(__itimer_which_t, const struct itimerval*, struct itimerval*))dlsym(RTLD_NEXT, "setitimer");
    return fails("time") ? -1 : call(which, timer, before);
}
