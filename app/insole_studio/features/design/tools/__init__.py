"""Tools of the mouse: a module each, run by ``tool_controller.ToolController``."""
