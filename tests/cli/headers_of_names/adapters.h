#define QA 3
