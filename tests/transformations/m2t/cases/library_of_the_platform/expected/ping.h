#ifndef PING_H
#define PING_H
#if defined(__cplusplus)
#endif
int32_t ping(int32_t pin);
int32_t ping_cm(int32_t pin);
int32_t ping_inches(int32_t pin);
typedef struct echo echo_t;
#if defined(__cplusplus)
#endif
#endif
