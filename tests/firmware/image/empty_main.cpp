// Startup code and nothing else: what the other images are measured against. With -u it becomes the image that holds
// every query.
int main() { return 0; }
