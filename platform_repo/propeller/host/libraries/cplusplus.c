/* What compiled C++ calls: memory of new and delete, a pure virtual function, destructors at the end, which never comes. */
#include <stdlib.h>

void *of_new(size_t bytes) __asm__("_Znwj");
void *of_new_array(size_t bytes) __asm__("_Znaj");
void of_delete(void *object) __asm__("_ZdlPv");
void of_delete_array(void *object) __asm__("_ZdaPv");
void of_sized_delete(void *object, size_t bytes) __asm__("_ZdlPvj");
void of_sized_delete_array(void *object, size_t bytes) __asm__("_ZdaPvj");
void __cxa_pure_virtual(void);
int __cxa_atexit(void (*destructor)(void *), void *object, void *library);
void *__dso_handle = 0;

void *of_new(size_t bytes) { return malloc(bytes ? bytes : 1); }

void *of_new_array(size_t bytes) { return of_new(bytes); }

void of_delete(void *object) { free(object); }

void of_delete_array(void *object) { free(object); }

void of_sized_delete(void *object, size_t bytes) {
  (void)bytes;
  free(object);
}

void of_sized_delete_array(void *object, size_t bytes) {
  (void)bytes;
  free(object);
}

void __cxa_pure_virtual(void) { exit(1); }

int __cxa_atexit(void (*destructor)(void *), void *object, void *library) {
  (void)destructor;
  (void)object;
  (void)library;
  return 0;
}
