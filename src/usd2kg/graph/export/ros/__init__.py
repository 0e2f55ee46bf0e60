"""Messages of ROS 2 from a property graph: static transforms, detections, and relations beside them."""
