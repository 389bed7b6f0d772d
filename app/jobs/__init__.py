"""Long work in processes of its own, with progress, time left and a way to give it up."""
