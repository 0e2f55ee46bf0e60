"""Language models in this process: weights in a GGUF file, read by llama.cpp, answers held to the schema."""
