"""ROS 2 messages from a property graph: static transforms and detections, with a file of relations."""
