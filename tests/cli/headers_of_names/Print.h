#define QB 4
